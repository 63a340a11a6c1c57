#include "studio/session.h"

#include <algorithm>
#include <iterator>
#include <new>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rholm/error.h"
#include "rholm/formats.h"
#include "rholm/version.h"
#include "studio/answers.h"
#include "studio/names.h"
#include "studio/open.h"
#include "studio/session_file.h"

namespace rholm::studio {
namespace {

constexpr std::size_t kMaxPast = 100;                        // steps; chosen: more than users undo
constexpr std::size_t kMaxPastBytes = std::size_t{2} << 30;  // chosen: what a laptop can spare

Json recipe_json(const Recipe& recipe) {
  return {{"shell", fmt::format("{}", fmt::join(recipe.shell, "\n"))},
          {"python", "import rholm\n" + fmt::format("{}", fmt::join(recipe.python, "\n"))}};
}

// Returns the formats that can be opened, with the kinds of items they give.
Json opened_json() {
  Json opened = Json::array();
  const auto add = [&](const FileFormat& format, const std::vector<const char*>& kinds) {
    if (!format.read) return;
    Json extensions = Json::array();
    for (const FileExtension& extension : format.extensions) extensions.push_back(extension.name);
    opened.push_back({{"format", format.name},
                      {"title", format.title},
                      {"extensions", std::move(extensions)},
                      {"kinds", kinds}});
  };
  for (const ShapeFormatInfo& format : shape_formats()) {
    std::vector<const char*> kinds;
    if (format.faces) kinds.push_back(to_string(Kind::kMesh));
    if (format.points) kinds.push_back(to_string(Kind::kPoints));
    add(format.file, kinds);
  }
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    std::vector<const char*> kinds = {to_string(Kind::kExpansion)};
    if (!format.format) kinds.push_back(to_string(Kind::kAtlas));
    add(format.file, kinds);
  }
  return opened;
}

// Adds to `to` what `changed` has and `before` does not have.
void add_new(const Document& changed, const Document& before, Document& to) {
  const auto append = [](const auto& all, std::size_t known, auto& list) {
    list.insert(list.end(), all.begin() + static_cast<std::ptrdiff_t>(known), all.end());
  };
  append(changed.items, before.items.size(), to.items);
  append(changed.recipe.steps, before.recipe.steps.size(), to.recipe.steps);
  append(changed.recipe.shell, before.recipe.shell.size(), to.recipe.shell);
  append(changed.recipe.python, before.recipe.python.size(), to.recipe.python);
  const auto take = [](const auto& all, const auto& known, auto& set) {
    std::set_difference(all.begin(), all.end(), known.begin(), known.end(),
                        std::inserter(set, set.end()));
  };
  take(changed.recipe.files, before.recipe.files, to.recipe.files);
  take(changed.recipe.variables, before.recipe.variables, to.recipe.variables);
}

}  // namespace

Session::Session(std::string id, int threads, std::size_t max_upload, Scratch& scratch,
                 Document beginning)
    : id_(std::move(id)),
      threads_(threads),
      max_upload_(max_upload),
      scratch_(scratch),
      shared_{.scratch = scratch},
      live_(threads),
      now_(std::move(beginning)) {
  for (const ItemPtr& item : now_.items) {
    shared_.items = std::max(shared_.items.load(), item->id);
    shared_.revisions = std::max(shared_.revisions.load(), item->revision);
  }
}

Session::~Session() {
  close();
  if (thread_.joinable()) thread_.join();
}

void Session::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  if (job_) job_->cancel();
  changed_.notify_all();
}

bool Session::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

Document Session::document() const {
  const std::lock_guard lock(mutex_);
  return now_;
}

Json Session::state() const {
  const std::lock_guard lock(mutex_);
  return state_locked();
}

Json Session::state_locked() const {
  Json items = Json::array();
  for (const ItemPtr& item : now_.items) items.push_back(json_of(*item));
  return {{"version", kVersion},
          {"session", id_},
          {"max_upload", max_upload_},
          {"opens", opened_json()},
          {"items", std::move(items)},
          {"undo", past_.empty() ? Json(nullptr) : Json(past_.back().label)},
          {"redo", future_.empty() ? Json(nullptr) : Json(future_.back().label)},
          {"recipe", recipe_json(with_looks(now_.recipe, now_.items))},
          {"job", job_ ? job_->json() : Json(nullptr)}};
}

void Session::refuse_while_busy() const {
  const std::lock_guard lock(mutex_);
  if (closed_) throw not_found("the session has ended");
  if (job_ && job_->running()) throw Refusal(409, "busy", "another job runs; wait or cancel it");
}

// Requires mutex_. The last step can always be undone.
void Session::forget_oldest() {
  if (past_.size() > kMaxPast) past_.erase(past_.begin());
  std::vector<const Document*> documents;
  documents.reserve(past_.size());
  for (const Moment& moment : past_) documents.push_back(&moment.document);
  while (documents.size() > 1 && bytes_of(documents) > kMaxPastBytes) {
    documents.erase(documents.begin());
    past_.erase(past_.begin());
    for (std::size_t i = 0; i < past_.size(); ++i) documents[i] = &past_[i].document;
  }
}

// Requires mutex_.
void Session::commit(const Step& step, Document document) {
  if (!step.first || !past_.empty()) {
    past_.push_back({step.label, std::move(now_)});
    forget_oldest();
  }
  future_.clear();
  now_ = std::move(document);
  ++state_number_;
  changed_.notify_all();
}

// An opened item exists before and after every step: all documents get it, with names that
// none of them has. The last document that can be redone has the names of all earlier ones.
Response Session::open(const std::string& name, std::string_view bytes,
                       const std::string& columns) {
  const std::lock_guard one(steps_);
  refuse_while_busy();
  Document last;
  {
    const std::lock_guard lock(mutex_);
    last = future_.empty() ? now_ : future_.front().document;
  }
  Document changed = last;
  const Context context = {.threads = threads_};
  if (columns.empty() && is_session_file(bytes)) {
    open_session(bytes, scratch_, changed, shared_, context);
  } else {
    Item item = open_item(name, bytes, scratch_, context, columns);
    add_reading(changed.recipe, item);
    if (!columns.empty()) record_columns(changed.recipe, item, columns);
    add(changed, std::move(item), shared_);
  }
  const std::lock_guard lock(mutex_);
  add_new(changed, last, now_);
  for (std::vector<Moment>* moments : {&past_, &future_}) {
    for (Moment& moment : *moments) add_new(changed, last, moment.document);
  }
  ++state_number_;
  changed_.notify_all();
  return json_response(state_locked());
}

Response Session::undo(bool redo) {
  const std::lock_guard lock(mutex_);
  std::vector<Moment>& from = redo ? future_ : past_;
  std::vector<Moment>& to = redo ? past_ : future_;
  if (from.empty()) {
    throw Refusal(422, "nothing", redo ? "there is nothing to redo" : "there is nothing to undo");
  }
  Moment moment = std::move(from.back());
  from.pop_back();
  to.push_back({moment.label, std::move(now_)});
  now_ = std::move(moment.document);
  ++state_number_;
  changed_.notify_all();
  return json_response(state_locked());
}

Response Session::degree_for_tolerance(const Json& request) const {
  const ItemPtr item = item_in(request, "item", document());
  if (!item->model) throw wrong_kind(*item, "it has no expansion yet; analyze it first");
  if (!item->model->beyond) throw wrong_kind(*item, "its errors are not known");
  const std::optional<int> degree =
      item->model->beyond->degree_within(number_of(request, "tolerance"));
  const int highest = item->model->expansion.coefficients.degree();
  return json_response({{"degree", degree.value_or(highest)}, {"met", degree.has_value()}});
}

Response Session::step(const Json& request) {
  const std::string op = string_of(request, "op");
  if (op == "degree_for") return degree_for_tolerance(request);
  const std::lock_guard one(steps_);
  refuse_while_busy();
  if (op == "undo" || op == "redo") return undo(op == "redo");
  Document changed = document();
  Step step = step_of(request, changed, shared_);
  step.first = flag_of(request, "first");
  if (step.slow) return start(std::move(step));
  step.work(changed, {.threads = threads_});
  const std::lock_guard lock(mutex_);
  commit(step, std::move(changed));
  return json_response(state_locked());
}

// Requires steps_, and that no job runs.
Response Session::start(Step step) {
  if (thread_.joinable()) thread_.join();  // the thread of a job that has ended
  const std::lock_guard lock(mutex_);
  if (closed_) throw not_found("the session has ended");
  job_ = std::make_shared<Job>(++jobs_, step.label, [this] { tell_of_job(); });
  ++job_number_;
  changed_.notify_all();
  thread_ = std::thread(
      [this, step = std::move(step), job = job_, document = now_] { run(step, job, document); });
  return json_response({{"job", job_->json()}}, 202);
}

// Runs on the job's thread. Its result appears as a whole, or not at all.
void Session::run(const Step& step, const std::shared_ptr<Job>& job, Document document) {
  std::string state = "done", message;
  try {
    const CancelScope scope([&] { return !job->cancelled(); });
    step.work(document, job->context(threads_));
  } catch (const Error& error) {
    state = error.code() == ErrorCode::kCancelled ? "cancelled" : "failed";
    message = error.what();
  } catch (const std::bad_alloc&) {
    state = "failed";
    message = "there is not enough memory for this";
  } catch (const std::exception& error) {
    state = "failed";
    message = error.what();
  }
  const std::lock_guard lock(mutex_);
  if (job->cancelled()) state = "cancelled";
  if (state == "done") commit(step, std::move(document));
  job->finish(state, message);
  ++job_number_;
  ++state_number_;
  changed_.notify_all();
}

void Session::tell_of_job() {
  const std::lock_guard lock(mutex_);
  ++job_number_;
  changed_.notify_all();
}

Response Session::cancel(int job) {
  const std::lock_guard lock(mutex_);
  if (!job_ || job_->id() != job) throw not_found(fmt::format("there is no job {}", job));
  job_->cancel();
  return json_response({{"job", job_->json()}});
}

Response Session::live(const Json& request) { return live_.answer(request, document()); }

Response Session::surface(int item, bool original) const {
  return surface_answer(*item_of(document(), item), original);
}

Response Session::measures(int item) const { return measures_answer(*item_of(document(), item)); }

Response Session::save(int item, const std::string& format, const std::string& size) const {
  const Document document_now = document();
  return save_answer(*item_of(document_now, item), document_now.recipe, format, size, scratch_,
                     {.threads = threads_});
}

Response Session::session_file() const {
  return {.type = "application/octet-stream",
          .body = session_bytes(document(), scratch_),
          .download = "session.rholm"};
}

std::vector<Event> Session::wait(EventMark& mark, std::chrono::milliseconds time) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, time, [&] {
    return closed_ || mark.state != state_number_ || mark.job != job_number_;
  });
  std::vector<Event> events;
  if (closed_) return events;
  if (mark.job != job_number_ && job_) events.push_back({"job", text_of(job_->json())});
  if (mark.state != state_number_) events.push_back({"state", text_of(state_locked())});
  mark = {state_number_, job_number_};
  return events;
}

}  // namespace rholm::studio
