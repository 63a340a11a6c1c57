// Sessions of a studio: which pages use them, and which are abandoned. Layer: studio.
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

// All functions may be called by several threads at once. Functions that need a session throw
// Refusal 404 if the name is unknown, and 503 if there are too many sessions for a new one.
class Sessions {
 public:
  Sessions(const StudioOptions& options, Scratch& scratch) : options_(options), scratch_(scratch) {}

  // Returns the offered session once. Otherwise makes a new one,
  // with the content that the offered session had when it was taken.
  std::shared_ptr<Session> next();
  // Makes a session and returns its name; an earlier offer stays as an unused session.
  std::string offer();
  std::shared_ptr<Session> find(const std::string& id);
  void end(const std::string& id);
  void end_all();
  // Drops sessions whose pages have been gone for longer than the patience.
  void drop_forgotten();
  // Returns how many sessions have ended and been released by all holders since the last call.
  std::size_t gone();

  // Register a listener's arrival and departure; a session with listeners is not dropped.
  void enter(const std::string& id);
  void leave(const std::string& id);

 private:
  using Clock = std::chrono::steady_clock;
  struct Place {
    std::shared_ptr<Session> session;
    int listeners = 0;
    std::optional<Clock::time_point> left = {};  // departure of the last listener
  };

  std::shared_ptr<Session> make();

  const StudioOptions& options_;
  Scratch& scratch_;
  std::mutex mutex_;  // guards the fields below
  std::map<std::string, Place> places_;
  std::vector<std::weak_ptr<const bool>> ended_;  // ended sessions; a request may still hold one
  std::string offered_;
  Document beginning_;
};

}  // namespace rholm::studio
