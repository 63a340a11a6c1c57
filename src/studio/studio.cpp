#include "studio/studio.h"

#include <charconv>
#include <new>
#include <random>

#include <fmt/format.h>

#include "rholm/context.h"
#include "rholm/error.h"
#include "studio/answers.h"

namespace rholm::studio {
namespace {

Response error_response(int status, const std::string& code, const std::string& message) {
  return json_response({{"error", {{"code", code}, {"message", message}}}}, status);
}

// "invalid_input" of "InvalidInput".
std::string code_name(ErrorCode code) {
  std::string name;
  for (const char c : std::string(to_string(code))) {
    if (c >= 'A' && c <= 'Z' && !name.empty()) name += '_';
    name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return name;
}

// 64 bits of the system's randomness.
std::string random_name() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

int number_in(const std::string& text) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) throw not_found(fmt::format("'{}' is no number", text));
  return number;
}

std::string value_of(const Request& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

Refusal unknown_path(const Request& request) {
  return not_found(fmt::format("there is no {} {}", request.method, request.path));
}

}  // namespace

Studio::Studio(StudioOptions options)
    : options_(std::move(options)),
      scratch_(options_.folder.empty() ? std::filesystem::path("/tmp") : options_.folder) {}

Response Studio::handle(const Request& request) {
  try {
    return answer(request);
  } catch (const Refusal& refusal) {
    return error_response(refusal.status(), refusal.code(), refusal.what());
  } catch (const Error& error) {
    return error_response(422, code_name(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return error_response(422, "out_of_memory", "there is not enough memory for this");
  } catch (const std::exception& error) {
    return error_response(422, "failed", error.what());
  }
}

Response Studio::answer(const Request& request) {
  drop_forgotten();
  if (request.path == "api/session" && request.method == "POST") return new_session();
  if (request.path == "api/quit" && request.method == "POST") {
    quitting_ = true;
    return json_response({{"quit", true}});
  }
  const std::string id = request.session.empty() ? value_of(request, "session") : request.session;
  if ((request.path == "api/session" && request.method == "DELETE") ||
      (request.path == "api/session/close" && request.method == "POST")) {
    return end_session(id);
  }
  return answer_in(*find(id), request);
}

Response Studio::answer_in(Session& session, const Request& request) {
  const std::string& path = request.path;
  const CancelScope scope(
      [&] { return !session.closed() && (!options_.keep_going || options_.keep_going()); });
  if (request.method == "GET") {
    if (path == "api/state") return json_response(session.state());
    if (path == "api/session-file") return session.session_file();
    if (path == "api/save") {
      return session.save(number_in(value_of(request, "item")), value_of(request, "format"),
                          value_of(request, "size"));
    }
    if (path.starts_with("api/item/")) return item_answer(session, path.substr(9), request);
    throw unknown_path(request);
  }
  if (request.method != "POST") throw unknown_path(request);
  if (path == "api/file") {
    if (request.body.size() > options_.max_upload) {
      throw Refusal(413, "too_large",
                    fmt::format("a file may have at most {} bytes; see rholm "
                                "studio --max-upload",
                                options_.max_upload));
    }
    return session.open(value_of(request, "name"), request.body);
  }
  if (path == "api/step") return session.step(parse_object(request.body));
  if (path == "api/live") return session.live(parse_object(request.body));
  if (path.starts_with("api/job/") && path.ends_with("/cancel")) {
    return session.cancel(number_in(path.substr(8, path.size() - 8 - 7)));
  }
  throw unknown_path(request);
}

// "ID/surface", "ID/measures".
Response Studio::item_answer(Session& session, const std::string& rest, const Request& request) {
  const std::size_t slash = rest.find('/');
  const std::string what = slash == std::string::npos ? "" : rest.substr(slash + 1);
  const int item = number_in(rest.substr(0, slash));
  if (what == "surface") return session.surface(item, value_of(request, "original") == "1");
  if (what == "measures") return session.measures(item);
  throw unknown_path(request);
}

// With mutex_ held.
std::shared_ptr<Session> Studio::make_session() {
  if (sessions_.size() >= options_.max_sessions) {
    throw Refusal(503, "too_many_sessions",
                  fmt::format("{} pages are open; close one first", sessions_.size()));
  }
  auto session = std::make_shared<Session>(random_name(), options_.threads, scratch_);
  sessions_[session->id()] = {.session = session};
  return session;
}

Response Studio::new_session() {
  std::shared_ptr<Session> session;
  {
    const std::lock_guard lock(mutex_);
    const auto offered = sessions_.find(offered_);
    session = offered == sessions_.end() ? make_session() : offered->second.session;
    offered_.clear();
  }
  return json_response({{"session", session->id()}, {"state", session->state()}});
}

std::string Studio::offered_session() {
  const std::lock_guard lock(mutex_);
  offered_ = make_session()->id();
  return offered_;
}

std::shared_ptr<Session> Studio::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(id);
  if (found == sessions_.end()) {
    throw Refusal(404, "no_session", "there is no such session; POST api/session begins one");
  }
  if (found->second.left) found->second.left = Clock::now();  // the page is there after all
  return found->second.session;
}

// Whoever holds the session last waits for its job, which is cancelled.
Response Studio::end_session(const std::string& id) {
  const std::shared_ptr<Session> session = find(id);
  session->close();
  const std::lock_guard lock(mutex_);
  sessions_.erase(id);
  return json_response({{"closed", true}});
}

// Sessions whose pages have gone.
void Studio::drop_forgotten() {
  std::vector<std::shared_ptr<Session>> dropped;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  for (auto place = sessions_.begin(); place != sessions_.end();) {
    const std::optional<Clock::time_point>& left = place->second.left;
    if (left && now - *left >= options_.patience) {
      place->second.session->close();
      dropped.push_back(place->second.session);
      place = sessions_.erase(place);
    } else {
      ++place;
    }
  }
}

std::unique_ptr<Studio::Listener> Studio::listen(const std::string& session) {
  try {
    return std::make_unique<Listener>(*this, find(session));
  } catch (const Refusal&) {
    return nullptr;
  }
}

Studio::Listener::Listener(Studio& studio, std::shared_ptr<Session> session)
    : studio_(studio), session_(std::move(session)) {
  const std::lock_guard lock(studio_.mutex_);
  const auto place = studio_.sessions_.find(session_->id());
  if (place == studio_.sessions_.end()) return;
  ++place->second.listeners;
  place->second.left.reset();
}

Studio::Listener::~Listener() {
  const std::lock_guard lock(studio_.mutex_);
  const auto place = studio_.sessions_.find(session_->id());
  if (place != studio_.sessions_.end() && --place->second.listeners == 0) {
    place->second.left = Clock::now();
  }
}

void Studio::close() {
  std::map<std::string, Place> all;
  {
    const std::lock_guard lock(mutex_);
    all.swap(sessions_);
  }
  for (auto& [id, place] : all) place.session->close();
}

}  // namespace rholm::studio
