// Ranks that work as one. Layer: cluster.
//
// Rank 0 leads: it runs what was asked for, and calls the others for their part. On every rank one
// thread speaks MPI, and nothing else, so that ranks hear each other whatever is computed; work is
// done on other threads, which send and receive by the functions here.
//
// However a run ends, all ranks end with the same code, and at most one message is printed. A rank
// whose work throws tells rank 0, which says what it was, and has all others stop; their work ends
// by Stopped. A rank that is silent, or at work without progress, for longer than the patience,
// ends the run in the same way; one that does not stop then is ended by MPI.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "cluster/transport.h"

namespace rholm {

class Watch;

// Thrown where a thread waits for other ranks, when the run is about to end.
struct Stopped : std::exception {};

// How work ended: an exit code, and what is to be said, if anything.
struct Ending {
  int code = 0;
  std::string message = {};
};

// Kinds of messages.
enum class Tag : int { kControl, kCall, kCollect, kTask, kHand, kTest };

// What all ranks have spent.
struct RankTotals {
  int ranks = 0;
  Traffic traffic;
  double cpu_seconds = 0;          // of all
  double longest_cpu_seconds = 0;  // of the one that has most
};

// What ranks ask of the program around them. All may be called from the thread that speaks MPI.
struct RanksProgram {
  std::function<std::uint64_t()> progress;        // grows while something is computed
  std::function<bool()> keep_going;               // asked while parts are worked; none: yes
  std::function<int()> interrupted;               // the signal that asked to stop, or 0
  std::function<void(int code)> stop;             // work is to end soon
  std::function<void(const std::string&)> error;  // prints it
  std::function<void(const RankTotals&)> ended;   // on rank 0, after a run that was not aborted
  std::function<void()> discard;                  // unfinished files, before an abort
  std::function<Ending(std::exception_ptr)> ending_of;  // what an exception comes to
  int failure = 1;  // the code of a rank that is stuck, or of MPI
};

class Ranks {
 public:
  // Begins MPI. Throws Io, Unsupported.
  explicit Ranks(RanksProgram program, std::size_t piece = std::size_t{1} << 30);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  // Runs `lead` on rank 0, `serve` on the others, until `lead` returns or anybody throws; returns
  // the code to exit with. `serve` ends by Stopped.
  int run(const std::function<Ending(Ranks&)>& lead, const std::function<void(Ranks&)>& serve);

  int rank() const { return transport_.rank(); }
  int size() const { return transport_.size(); }
  int processors() const { return transport_.processors(); }

  // Sends bytes of any size; returns at once. Any thread.
  void send(int to, Tag tag, std::string bytes);
  // The next message of that kind, in the order in which they arrived; from any rank, or that one.
  // Throws Stopped.
  Packet receive(Tag tag, std::optional<int> from = {});
  bool is_stopping() const { return stopping_; }
  bool keep_going() const { return !stopping_ && (!program_.keep_going || program_.keep_going()); }
  // What was thrown on a thread of this rank ends the run, from now on: the first one counts.
  // Stopped is none. Any thread.
  void fail(const std::exception_ptr& what);

  // Something to do begins and ends: what lies between is to show progress.
  void begin_work() { ++working_; }
  void end_work();

  // On rank 0: seconds without a sign of life or of progress after which the run ends.
  void set_patience(double seconds);
  // On rank 0: what is added to a message about a run that did not end well: how to go on. Asked on
  // the thread that speaks MPI, also when the work has ended.
  void set_hint(std::function<std::string()> hint);

 private:
  enum class State { kRunning, kStopping, kAcknowledged, kLeft };

  void speak();  // until the run is over
  void take_outgoing();
  void deliver(Packet packet);
  void control(const Packet& packet);
  void send_pulse();
  void look_at_others(double now);
  void look_at_own_work();
  void tell(const Ending& ending);  // how this rank's work ended
  void decide(const Ending& ending, int rank);
  void stop(int code);
  void move_on(double now);
  std::string of_rank(int rank, const std::string& text) const;
  std::string with_hint(const std::string& text);
  [[noreturn]] void abort();

  RanksProgram program_;
  Transport transport_;
  std::atomic<bool> stopping_ = false;
  std::atomic<int> working_ = 0;
  std::atomic<std::uint64_t> done_ = 0;  // pieces of work
  std::atomic<double> patience_ = 300;
  std::atomic<bool> pulse_wanted_ = false;  // at once

  std::mutex mutex_;  // of what follows
  std::condition_variable arrived_, leaving_;
  std::map<Tag, std::deque<Packet>> mailbox_;
  std::deque<Packet> outgoing_;
  std::optional<Ending> own_ending_;  // of the work of this rank
  bool has_ended_ = false;            // and whether its thread has
  std::function<std::string()> hint_;

  // Of the thread that speaks.
  State state_ = State::kRunning;
  bool has_told_ = false;  // its failure, to rank 0
  int code_ = 0;
  double stopped_at_ = 0;
  double given_up_until_ = 0;  // the others may have given this rank up, and said so
  int acknowledged_ = 0;
  RankTotals totals_;
  std::map<int, std::string> hosts_;
  std::unique_ptr<Watch> watch_;
};

// Tells that something is worked on for as long as it lives.
class RankAtWork {
 public:
  explicit RankAtWork(Ranks& ranks) : ranks_(ranks) { ranks_.begin_work(); }
  ~RankAtWork() { ranks_.end_work(); }
  RankAtWork(const RankAtWork&) = delete;
  RankAtWork& operator=(const RankAtWork&) = delete;

 private:
  Ranks& ranks_;
};

}  // namespace rholm
