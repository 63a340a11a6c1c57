// The studio without a transport: requests in, responses out, events for those who listen.
// Layer: studio. docs/studio.md has what may be asked.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "studio/items/message.h"
#include "studio/session.h"

namespace rholm::studio {

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

class Studio {
 public:
  explicit Studio(StudioOptions options);

  // Answers any request, also wrong ones, by statuses of errors, not by exceptions. May be called
  // by several threads at once.
  Response handle(const Request& request);

  // A session for the next page that asks for a new one, with shapes in it: what is opened in it
  // before (POST api/file) is what the page begins with.
  std::string offered_session();

  // Who listens to a session. While one does it is not dropped.
  class Listener {
   public:
    Listener(Studio& studio, std::shared_ptr<Session> session);
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    // What is new; waits so long for it. Nothing if nothing is, or the session has ended.
    std::vector<Event> wait(std::chrono::milliseconds time) { return session_->wait(mark_, time); }
    bool ended() const { return session_->closed(); }

   private:
    Studio& studio_;
    std::shared_ptr<Session> session_;
    EventMark mark_;
  };
  // nullptr for a session that is not there.
  std::unique_ptr<Listener> listen(const std::string& session);

  // Whether a page has asked to end it all (POST api/quit).
  bool quitting() const { return quitting_; }
  // Ends all sessions: jobs are cancelled, listeners wake.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Place {
    std::shared_ptr<Session> session;
    int listeners = 0;
    std::optional<Clock::time_point> left = {};  // when the last listener went
  };

  Response answer(const Request& request);
  Response answer_in(Session& session, const Request& request);
  Response item_answer(Session& session, const std::string& rest, const Request& request);
  Response new_session();
  Response end_session(const std::string& id);
  std::shared_ptr<Session> make_session();
  std::shared_ptr<Session> find(const std::string& id);
  void drop_forgotten();

  const StudioOptions options_;
  Scratch scratch_;
  std::mutex mutex_;  // of what follows
  std::map<std::string, Place> sessions_;
  std::string offered_;
  std::atomic<bool> quitting_{false};
};

}  // namespace rholm::studio
