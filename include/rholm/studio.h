// Editing of shapes in a web page: `rholm studio` serves it by HTTP, notebooks by messages.
// Layer: studio.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rholm/fields.h"

namespace rholm {

// Largest JSON body in bytes. Chosen: room for a million points.
inline constexpr std::size_t kMaxStudioJson = std::size_t{16} << 20;

// A request of a page, as in HTTP but without a transport. docs/studio.md lists all requests.
struct StudioRequest {
  std::string method = "GET";                     // "GET", "POST", "DELETE"
  std::string path = {};                          // below the page's address: "api/state"
  std::map<std::string, std::string> query = {};  // decoded
  std::string body = {};                          // bytes
  std::string session = {};                       // header X-Session, may be empty
};

// The answer to a request.
struct StudioResponse {
  int status = 200;                       // HTTP status
  std::string type = "application/json";  // media type of the body
  std::string body = {};                  // bytes
  std::string download = {};              // name of a file to save the body in; empty: none
};

// A message that a session sends without a request.
struct StudioEvent {
  std::string name = {};  // "state", "job"
  std::string data = {};  // JSON on one line
};

// Resources and limits of a studio.
struct StudioOptions {
  std::filesystem::path folder = {};  // parent folder of one temporary folder, removed at the end
  int threads = 0;                    // threads of the library; 0: one per processor
  std::size_t max_upload = (std::size_t{1} << 31) - 1;  // largest file in bytes
  std::size_t max_sessions = 16;  // largest number of pages; chosen above common use
  // Returns false to stop; called now and then by several threads while a request is answered.
  std::function<bool()> keep_going = {};
  // Time a session waits for a page that has closed its event stream.
  std::chrono::milliseconds patience = std::chrono::seconds(60);
};

// Lists the fields of StudioOptions, without the function and the time.
template <typename Visitor>
void visit_fields(FieldsOf<StudioOptions>, const Visitor& field) {
  using O = StudioOptions;
  field(&O::folder, {.name = "folder",
                     .help = "folder for temporary files; by default /tmp",
                     .in_program = false});
  field(&O::threads, {.name = "threads",
                      .help = "threads of the library; 0: one per processor",
                      .value = "N",
                      .least = 0,
                      .changes_result = false,
                      .in_program = false});
  field(&O::max_upload, {.name = "max_upload",
                         .help = "largest file that a page may send",
                         .value = "BYTES",
                         .least = 1,
                         .unit = FieldUnit::kBytes});
  field(&O::max_sessions, {.name = "max_sessions",
                           .help = "pages at a time",
                           .value = "N",
                           .least = 1,
                           .in_program = false});
}

// A receiver of a session's events. A session with a listener is not dropped. Must not outlive the
// studio.
class StudioListener {
 public:
  ~StudioListener();
  StudioListener(const StudioListener&) = delete;
  StudioListener& operator=(const StudioListener&) = delete;
  // Waits at most `time` for new events, and returns them; none if none come or at the end.
  std::vector<StudioEvent> wait(std::chrono::milliseconds time);
  bool ended() const;

 private:
  friend class Studio;
  struct State;
  explicit StudioListener(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// The studio without a transport: takes requests, returns responses, sends events to listeners. All
// functions may be called by several threads at once.
class Studio {
 public:
  // Writes nothing before the first request.
  explicit Studio(StudioOptions options = {});
  ~Studio();  // cancels running jobs and waits for them
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  // Answers any request. Wrong requests get an error status, not an exception.
  StudioResponse handle(const StudioRequest& request);

  // Makes a session for the next page that asks for a new one. Shapes opened in it before (POST
  // api/file) appear in that page and every later one.
  std::string offered_session();

  // Listens to a session; nullptr if there is none of that name.
  std::unique_ptr<StudioListener> listen(const std::string& session);

  // Ends sessions whose pages have gone, with their jobs, and returns the memory of ended sessions
  // to the system. The caller calls it some times a second.
  void tend();
  // Returns true if a page has asked to quit (POST api/quit).
  bool quitting() const;
  // Ends all sessions: cancels jobs and wakes listeners.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rholm
