// Shapes that people work on in a page: what `rholm studio` serves by HTTP, and notebooks by
// messages. Layer: studio.
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

// Bytes of a body of JSON. Chosen: a million points.
inline constexpr std::size_t kMaxStudioJson = std::size_t{16} << 20;

// What a page asks, as of HTTP, without it. docs/studio.md has what may be asked.
struct StudioRequest {
  std::string method = "GET";                     // "GET", "POST", "DELETE"
  std::string path = {};                          // below the address of the page: "api/state"
  std::map<std::string, std::string> query = {};  // decoded
  std::string body = {};                          // bytes
  std::string session = {};                       // header X-Session, may be empty
};

// What it is answered.
struct StudioResponse {
  int status = 200;                       // of HTTP
  std::string type = "application/json";  // of the body
  std::string body = {};                  // bytes
  std::string download = {};              // name of a file to be saved; empty: none
};

// What a session tells by itself.
struct StudioEvent {
  std::string name = {};  // "state", "job"
  std::string data = {};  // JSON in one line
};

// How a studio works.
struct StudioOptions {
  std::filesystem::path folder = {};  // for temporary files: one folder in it, gone at the end
  int threads = 0;                    // of the library; 0: one per processor
  std::size_t max_upload = (std::size_t{1} << 31) - 1;  // bytes of a file
  std::size_t max_sessions = 16;  // chosen: more pages than that nobody looks at
  // Asked from time to time while a request is answered, by several threads: whether to go on.
  std::function<bool()> keep_going = {};
  // How long a session waits for a page that has closed its event stream.
  std::chrono::milliseconds patience = std::chrono::seconds(60);
};

// Their list (fields.h), without the function and the time.
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

// Who listens to a session. While one does, the session is not dropped. Must not outlive the
// studio.
class StudioListener {
 public:
  ~StudioListener();
  StudioListener(const StudioListener&) = delete;
  StudioListener& operator=(const StudioListener&) = delete;
  // What is new; waits so long for it. Nothing if nothing is, or the session has ended.
  std::vector<StudioEvent> wait(std::chrono::milliseconds time);
  bool ended() const;

 private:
  friend class Studio;
  struct State;
  explicit StudioListener(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// The studio without a transport: requests in, responses out, events for those who listen. All
// functions may be called by several threads at once.
class Studio {
 public:
  // Nothing is written before somebody asks.
  explicit Studio(StudioOptions options = {});
  ~Studio();  // cancels what runs, and waits for it
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  // Answers any request, also wrong ones, by statuses of errors, not by exceptions.
  StudioResponse handle(const StudioRequest& request);

  // A session for the next page that asks for a new one, with shapes in it: what is opened in it
  // before (POST api/file) is what that page, and every one after it, begins with.
  std::string offered_session();

  // nullptr for a session that is not there.
  std::unique_ptr<StudioListener> listen(const std::string& session);

  // To be called some times a second: ends sessions whose pages have gone, with their jobs, and
  // gives the memory of those that have ended back to the system.
  void tend();
  // Whether a page has asked to end it all (POST api/quit).
  bool quitting() const;
  // Ends all sessions: jobs are cancelled, listeners wake.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rholm
