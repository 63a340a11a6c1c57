// Work of one page: its shapes, the undo history, the running job. Layer: studio.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "studio/items/message.h"
#include "studio/job.h"
#include "studio/live.h"
#include "studio/scratch.h"
#include "studio/step.h"

namespace rholm::studio {

// Marks the changes of which a listener has been informed.
struct EventMark {
  std::uint64_t state = 0, job = 0;
};

// All functions may be called by several threads at
// once. They throw Refusal and the library's errors.
class Session {
 public:
  // `max_upload`: limit of a file in bytes, shown by pages. `beginning`: initial content.
  Session(std::string id, int threads, std::size_t max_upload, Scratch& scratch,
          Document beginning = {});
  ~Session();  // cancels the job and waits for it
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const std::string& id() const { return id_; }
  // Expires when the session is destroyed and its memory is free.
  std::weak_ptr<const bool> life() const { return life_; }
  Json state() const;
  Document document() const;
  // Opens a file of any kind that the program reads, or adds the
  // items of a session file. This is not a step, so undoing does not
  // close it. `columns` are the columns of a text table, if known.
  Response open(const std::string& name, std::string_view bytes, const std::string& columns = {});
  Response step(const Json& request);
  Response live(const Json& request);
  Response surface(int item, bool original) const;
  Response measures(int item) const;
  Response save(int item, const std::string& format, const std::string& size) const;
  Response session_file() const;
  Response cancel(int job);

  // Returns the changes since the mark and moves it; waits for a change up to `time`.
  std::vector<Event> wait(EventMark& mark, std::chrono::milliseconds time) const;
  // Ends all waiting.
  void close();
  bool closed() const;

 private:
  struct Moment {
    std::string label;  // label of the step between this document and the next one
    Document document;
  };

  Json state_locked() const;
  void refuse_while_busy() const;
  void commit(const Step& step, Document document);
  void forget_oldest();
  Response undo(bool redo);
  Response degree_for_tolerance(const Json& request) const;
  Response start(Step step);
  void run(const Step& step, const std::shared_ptr<Job>& job, Document document);
  void tell_of_job();

  const std::shared_ptr<const bool> life_ = std::make_shared<const bool>(true);  // destroyed last
  const std::string id_;
  const int threads_;
  const std::size_t max_upload_;
  Scratch& scratch_;
  Shared shared_;
  Live live_;
  std::mutex steps_;          // locked by threads that change the document without a job
  mutable std::mutex mutex_;  // guards all fields below
  mutable std::condition_variable changed_;
  Document now_;
  std::vector<Moment> past_, future_;
  std::shared_ptr<Job> job_;  // the last one
  int jobs_ = 0;
  std::uint64_t state_number_ = 1, job_number_ = 0;
  bool closed_ = false;
  std::thread thread_;
};

}  // namespace rholm::studio
