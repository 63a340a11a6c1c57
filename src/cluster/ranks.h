// Ranks that work together on one run. Layer: cluster.
//
// Rank 0 leads: it runs the command, and calls the others for their part of the work. On every
// rank, one thread does nothing but speak MPI, so that ranks hear each other during any
// computation. Other threads do the work; they send and receive by the functions here.
//
// However a run ends, all ranks end with the same code, and at most one message is printed. A rank
// whose work throws tells rank 0. Rank 0 prints the message and makes all others stop; their work
// ends by Stopped. The run ends in the same way if a rank is silent, or at work without progress,
// for longer than the patience. MPI ends a rank that does not stop then.
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

// Thrown in a thread that waits for other ranks, when the run is about to end.
struct Stopped : std::exception {};

// How work ended: an exit code, and a message to be printed unless it is empty.
struct Ending {
  int code = 0;
  std::string message = {};
};

// Kinds of messages.
enum class Tag : int { kControl, kCall, kCollect, kTask, kHand, kTest };

// Resources that all ranks have used.
struct RankTotals {
  int ranks = 0;
  Traffic traffic;
  double cpu_seconds = 0;          // sum over all ranks
  double longest_cpu_seconds = 0;  // largest value of one rank
};

// Callbacks to the program around the ranks. The thread that speaks MPI may call all of them.
struct RanksProgram {
  std::function<std::uint64_t()> progress;        // grows while something is computed
  std::function<bool()> keep_going;               // asked while parts are computed; empty: yes
  std::function<int()> interrupted;               // returns the signal that asked to stop, or 0
  std::function<void(int code)> stop;             // announces that work is to end soon
  std::function<void(const std::string&)> error;  // prints a message
  std::function<void(const RankTotals&)> ended;   // called on rank 0, unless a run was aborted
  std::function<void()> discard;                  // removes unfinished files before an abort
  std::function<Ending(std::exception_ptr)> ending_of;  // code and message of an exception
  int failure = 1;  // exit code of a rank that is stuck, and after an error of MPI
};

class Ranks {
 public:
  // Begins MPI. Throws Io, Unsupported.
  explicit Ranks(RanksProgram program, std::size_t piece = std::size_t{1} << 30);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  // Runs `lead` on rank 0 and `serve` on the others, until `lead` returns or any of them throws.
  // Returns the code to exit with. `serve` ends by Stopped.
  int run(const std::function<Ending(Ranks&)>& lead, const std::function<void(Ranks&)>& serve);

  int rank() const { return transport_.rank(); }
  int size() const { return transport_.size(); }
  int processors() const { return transport_.processors(); }

  // Sends bytes of any size and returns at once. Any thread may call it.
  void send(int to, Tag tag, std::string bytes);
  // Waits for the next message of that kind and returns it, in the order of arrival; from any rank,
  // or from rank `from`. Throws Stopped.
  Packet receive(Tag tag, std::optional<int> from = {});
  bool is_stopping() const { return stopping_; }
  bool keep_going() const { return !stopping_ && (!program_.keep_going || program_.keep_going()); }
  // Ends the run because of an exception on a thread of this rank. The first call counts; Stopped
  // is ignored. Any thread may call it.
  void fail(const std::exception_ptr& what);

  // Mark the beginning and the end of work. Progress is expected in between.
  void begin_work() { ++working_; }
  void end_work();

  // Called on rank 0. The run ends after that many seconds without a sign of life or of progress.
  void set_patience(double seconds);
  // Called on rank 0. `hint` returns what is added to a message about a run that failed: how to go
  // on. The thread that speaks MPI calls it, also when the work has ended.
  void set_hint(std::function<std::string()> hint);

 private:
  enum class State { kRunning, kStopping, kAcknowledged, kLeft };

  void speak();  // runs until the run is over
  void take_outgoing();
  void deliver(Packet packet);
  void control(const Packet& packet);
  void send_pulse();
  void look_at_others(double now);
  void look_at_own_work();
  void tell(const Ending& ending);  // reports how this rank's work ended
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
  std::atomic<std::uint64_t> done_ = 0;  // number of finished pieces of work
  std::atomic<double> patience_ = 300;
  std::atomic<bool> pulse_wanted_ = false;  // true where a pulse is sent at once

  std::mutex mutex_;  // guards the members up to hint_
  std::condition_variable arrived_, leaving_;
  std::map<Tag, std::deque<Packet>> mailbox_;
  std::deque<Packet> outgoing_;
  std::optional<Ending> own_ending_;  // how the work of this rank ended
  bool has_ended_ = false;            // true once its thread has ended
  std::function<std::string()> hint_;

  // Members of the thread that speaks MPI.
  State state_ = State::kRunning;
  bool has_told_ = false;  // true once rank 0 knows how this rank's work ended
  int code_ = 0;
  double stopped_at_ = 0;
  double given_up_until_ = 0;  // until then, the others may have given up this rank
  int acknowledged_ = 0;
  RankTotals totals_;
  std::map<int, std::string> hosts_;
  std::unique_ptr<Watch> watch_;
};

// Marks work as going on for as long as this object lives.
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
