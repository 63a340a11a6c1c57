#include "rholm/studio.h"

#include <atomic>
#include <charconv>
#include <new>

#include <fmt/format.h>

#include "base/check_fields.h"
#include "base/large_vector.h"
#include "rholm/context.h"
#include "rholm/error_info.h"
#include "studio/answers.h"
#include "studio/controls.h"
#include "studio/sessions.h"

namespace rholm {

using studio::Refusal;

// Members are in the order of construction: sessions use the members above.
struct Studio::State {
  explicit State(StudioOptions wanted)
      : options(std::move(wanted)),
        scratch(options.folder.empty() ? std::filesystem::path("/tmp") : options.folder) {}

  StudioResponse answer(const StudioRequest& request);
  StudioResponse answer_in(studio::Session& session, const StudioRequest& request);

  const StudioOptions options;
  studio::Scratch scratch;
  studio::Sessions sessions{options, scratch};
  std::atomic<bool> quitting{false};
};

struct StudioListener::State {
  State(studio::Sessions& all, std::shared_ptr<studio::Session> listened)
      : sessions(all), session(std::move(listened)) {
    sessions.enter(session->id());
  }
  ~State() { sessions.leave(session->id()); }

  studio::Sessions& sessions;
  const std::shared_ptr<studio::Session> session;
  studio::EventMark mark = {};
};

namespace {

StudioResponse error_response(int status, const std::string& code, const std::string& message) {
  return studio::json_response({{"error", {{"code", code}, {"message", message}}}}, status);
}

int number_in(const std::string& text) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end)
    throw studio::not_found(fmt::format("'{}' is no number", text));
  return number;
}

std::string value_of(const StudioRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

Refusal unknown_path(const StudioRequest& request) {
  return studio::not_found(fmt::format("there is no {} {}", request.method, request.path));
}

// Answers "ID/surface" and "ID/measures".
StudioResponse item_answer(studio::Session& session, const std::string& rest,
                           const StudioRequest& request) {
  const std::size_t slash = rest.find('/');
  const std::string what = slash == std::string::npos ? "" : rest.substr(slash + 1);
  const int item = number_in(rest.substr(0, slash));
  if (what == "surface") return session.surface(item, value_of(request, "original") == "1");
  if (what == "measures") return session.measures(item);
  throw unknown_path(request);
}

}  // namespace

StudioResponse Studio::State::answer(const StudioRequest& request) {
  sessions.drop_forgotten();
  if (request.path == "api/session" && request.method == "POST") {
    const std::shared_ptr<studio::Session> session = sessions.next();
    return studio::json_response({{"session", session->id()}, {"state", session->state()}});
  }
  if (request.path == "api/quit" && request.method == "POST") {
    quitting = true;
    return studio::json_response({{"quit", true}});
  }
  const std::string id = request.session.empty() ? value_of(request, "session") : request.session;
  if ((request.path == "api/session" && request.method == "DELETE") ||
      (request.path == "api/session/close" && request.method == "POST")) {
    sessions.end(id);
    return studio::json_response({{"closed", true}});
  }
  return answer_in(*sessions.find(id), request);
}

StudioResponse Studio::State::answer_in(studio::Session& session, const StudioRequest& request) {
  const std::string& path = request.path;
  const CancelScope scope(
      [&] { return !session.closed() && (!options.keep_going || options.keep_going()); });
  if (request.method == "GET") {
    if (path == "api/state") return studio::json_response(session.state());
    if (path == "api/controls") return studio::controls_answer();
    if (path == "api/windows") return studio::windows_answer();
    if (path == "api/gains") return studio::gains_answer(request.query);
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
    if (request.body.size() > options.max_upload) {
      throw Refusal(413, "too_large",
                    fmt::format("a file may have at most {} bytes; see rholm "
                                "studio --max-upload",
                                options.max_upload));
    }
    return session.open(value_of(request, "name"), request.body, value_of(request, "columns"));
  }
  if (request.body.size() > kMaxStudioJson) {
    throw Refusal(413, "too_large",
                  fmt::format("the body of a request may have at most {} bytes", kMaxStudioJson));
  }
  if (path == "api/step") return session.step(studio::parse_object(request.body));
  if (path == "api/live") return session.live(studio::parse_object(request.body));
  if (path.starts_with("api/job/") && path.ends_with("/cancel")) {
    return session.cancel(number_in(path.substr(8, path.size() - 8 - 7)));
  }
  throw unknown_path(request);
}

Studio::Studio(StudioOptions options) {
  check_fields(options);
  state_ = std::make_unique<State>(std::move(options));
}
Studio::~Studio() { close(); }

StudioResponse Studio::handle(const StudioRequest& request) {
  try {
    return state_->answer(request);
  } catch (const Refusal& refusal) {
    return error_response(refusal.status(), refusal.code(), refusal.what());
  } catch (const Error& error) {
    return error_response(422, snake_case_name(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return error_response(422, "out_of_memory", "there is not enough memory for this");
  } catch (const std::exception& error) {
    return error_response(422, "failed", error.what());
  }
}

std::string Studio::offered_session() { return state_->sessions.offer(); }
void Studio::tend() {
  state_->sessions.drop_forgotten();
  if (state_->sessions.gone() > 0) return_free_memory();
}

bool Studio::quitting() const { return state_->quitting; }
void Studio::close() { state_->sessions.end_all(); }

std::unique_ptr<StudioListener> Studio::listen(const std::string& session) {
  try {
    auto state =
        std::make_unique<StudioListener::State>(state_->sessions, state_->sessions.find(session));
    return std::unique_ptr<StudioListener>(new StudioListener(std::move(state)));
  } catch (const Refusal&) {
    return nullptr;
  }
}

StudioListener::StudioListener(std::unique_ptr<State> state) : state_(std::move(state)) {}
StudioListener::~StudioListener() = default;

std::vector<StudioEvent> StudioListener::wait(std::chrono::milliseconds time) {
  return state_->session->wait(state_->mark, time);
}
bool StudioListener::ended() const { return state_->session->closed(); }

}  // namespace rholm
