// The sessions of a studio: who works on which, and which nobody does any more. Layer: studio.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "rholm/studio.h"
#include "studio/scratch.h"
#include "studio/session.h"

namespace rholm::studio {

// All functions may be called by several threads at once. Those that want a session throw Refusal
// 404 where there is none of the name, and 503 where there are too many for a new one.
class Sessions {
 public:
  Sessions(const StudioOptions& options, Scratch& scratch) : options_(options), scratch_(scratch) {}

  // The session that has been offered, once; else a new one, with what was in that one when it was
  // taken.
  std::shared_ptr<Session> next();
  // Its name; one that was offered before stays a session nobody has asked for.
  std::string offer();
  std::shared_ptr<Session> find(const std::string& id);
  void end(const std::string& id);
  void end_all();
  // Those whose pages have gone for longer than the patience.
  void drop_forgotten();
  // How many have ended and been given up by all who held them, since this was asked last.
  std::size_t gone();

  // Who listens comes and goes; while one does, the session is not dropped.
  void enter(const std::string& id);
  void leave(const std::string& id);

 private:
  using Clock = std::chrono::steady_clock;
  struct Place {
    std::shared_ptr<Session> session;
    int listeners = 0;
    std::optional<Clock::time_point> left = {};  // when the last listener went
  };

  std::shared_ptr<Session> make();

  const StudioOptions& options_;
  Scratch& scratch_;
  std::mutex mutex_;  // of what follows
  std::map<std::string, Place> places_;
  std::vector<std::weak_ptr<const bool>> ended_;  // sessions; who answers in one may still hold it
  std::string offered_;
  Document beginning_;
};

}  // namespace rholm::studio
