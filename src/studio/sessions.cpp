#include "studio/sessions.h"

#include <random>

#include <fmt/format.h>

namespace rholm::studio {
namespace {

// Returns 64 bits of the system's randomness.
std::string random_name() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

}  // namespace

// Requires mutex_.
std::shared_ptr<Session> Sessions::make() {
  if (places_.size() >= options_.max_sessions) {
    throw Refusal(503, "too_many_sessions",
                  fmt::format("{} pages are open; close one first", places_.size()));
  }
  auto session = std::make_shared<Session>(random_name(), options_.threads, options_.max_upload,
                                           scratch_, beginning_);
  places_[session->id()] = {.session = session};
  return session;
}

std::shared_ptr<Session> Sessions::next() {
  const std::lock_guard lock(mutex_);
  const auto offered = places_.find(offered_);
  offered_.clear();
  if (offered == places_.end()) return make();
  beginning_ = offered->second.session->document();
  return offered->second.session;
}

std::string Sessions::offer() {
  const std::lock_guard lock(mutex_);
  offered_ = make()->id();
  return offered_;
}

std::shared_ptr<Session> Sessions::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = places_.find(id);
  if (found == places_.end()) {
    throw Refusal(404, "no_session", "there is no such session; POST api/session begins one");
  }
  if (found->second.left) found->second.left = Clock::now();  // the page still exists
  return found->second.session;
}

// The last holder of the session waits for its job, which is cancelled.
void Sessions::end(const std::string& id) {
  const std::shared_ptr<Session> session = find(id);
  session->close();
  const std::lock_guard lock(mutex_);
  places_.erase(id);
  ended_.push_back(session->life());
}

void Sessions::end_all() {
  std::map<std::string, Place> all;
  {
    const std::lock_guard lock(mutex_);
    all.swap(places_);
  }
  for (auto& [id, place] : all) place.session->close();
}

void Sessions::drop_forgotten() {
  std::vector<std::shared_ptr<Session>> dropped;  // destroyed after the lock
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  for (auto place = places_.begin(); place != places_.end();) {
    const std::optional<Clock::time_point>& left = place->second.left;
    if (left && now - *left >= options_.patience) {
      place->second.session->close();
      dropped.push_back(place->second.session);
      ended_.push_back(place->second.session->life());
      place = places_.erase(place);
    } else {
      ++place;
    }
  }
}

std::size_t Sessions::gone() {
  const std::lock_guard lock(mutex_);
  return std::erase_if(ended_, [](const auto& life) { return life.expired(); });
}

void Sessions::enter(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(id);
  if (place == places_.end()) return;
  ++place->second.listeners;
  place->second.left.reset();
}

void Sessions::leave(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(id);
  if (place != places_.end() && --place->second.listeners == 0) place->second.left = Clock::now();
}

}  // namespace rholm::studio
