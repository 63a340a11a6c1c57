#include "cluster/ranks.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/bytes.h"
#include "cluster/watch.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using namespace std::chrono_literals;

// Kinds of messages with the tag kControl.
enum class Word : std::uint64_t { kPulse, kFailed, kStop, kStopped, kLeave };

constexpr double kPulseSeconds = 1;  // chosen: rare beside messages, often beside any patience
constexpr double kGraceSeconds = 5;  // chosen: for loops that seldom ask whether to stop
constexpr double kAbortSeconds = 6;  // chosen: by then an abort has ended all ranks
// Pauses between polls. Chosen: the shortest one while messages come and go, up to the longest one
// when none do, which takes 2 to 3 % of a processor.
constexpr std::chrono::microseconds kShortest = 50us, kLongest = 1ms;

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string word(Word which) {
  return ByteWriter().number(static_cast<std::uint64_t>(which)).take();
}

}  // namespace

Ranks::Ranks(RanksProgram program, std::size_t piece)
    : program_(std::move(program)), transport_(piece) {}

Ranks::~Ranks() = default;

int Ranks::run(const std::function<Ending(Ranks&)>& lead,
               const std::function<void(Ranks&)>& serve) {
  watch_ = std::make_unique<Watch>(size(), now_seconds());
  std::jthread work([&] {
    std::optional<Ending> ending;
    try {
      if (rank() == 0)
        ending = lead(*this);
      else
        serve(*this);
    } catch (...) {
      fail(std::current_exception());
    }
    const std::lock_guard lock(mutex_);
    if (!own_ending_) own_ending_ = std::move(ending);
    has_ended_ = true;
    leaving_.notify_one();
  });
  try {
    speak();
  } catch (const Error& error) {
    // The error comes from MPI: no other rank can be reached any more.
    program_.error(of_rank(rank(), error.what()));
    code_ = program_.failure;
    abort();
  }
  work.join();
  if (rank() == 0 && program_.ended) program_.ended(totals_);
  return code_;
}

void Ranks::send(int to, Tag tag, std::string bytes) {
  const std::lock_guard lock(mutex_);
  outgoing_.push_back({to, static_cast<int>(tag), std::move(bytes)});
  leaving_.notify_one();
}

Packet Ranks::receive(Tag tag, std::optional<int> from) {
  std::unique_lock lock(mutex_);
  std::deque<Packet>& box = mailbox_[tag];
  const auto find = [&] {
    return std::ranges::find_if(box, [&](const Packet& p) { return !from || p.from == *from; });
  };
  arrived_.wait(lock, [&] { return stopping_ || find() != box.end(); });
  if (stopping_) throw Stopped();
  const auto found = find();
  Packet packet = std::move(*found);
  box.erase(found);
  return packet;
}

void Ranks::fail(const std::exception_ptr& what) {
  std::optional<Ending> ending;
  try {
    std::rethrow_exception(what);
  } catch (const Stopped&) {
    return;
  } catch (...) {
    ending = program_.ending_of(what);
  }
  const std::lock_guard lock(mutex_);
  if (!own_ending_) own_ending_ = std::move(ending);
  leaving_.notify_one();
}

void Ranks::end_work() {
  ++done_;
  --working_;
}

// The next pulse goes out at once: others know the patience before anything happens to this rank.
void Ranks::set_patience(double seconds) {
  patience_ = seconds;
  pulse_wanted_ = true;
}

void Ranks::set_hint(std::function<std::string()> hint) {
  const std::lock_guard lock(mutex_);
  hint_ = std::move(hint);
}

void Ranks::speak() {
  double pulse_due = 0, looked = now_seconds();
  std::chrono::microseconds pause = kShortest;
  while (state_ != State::kLeft) {
    take_outgoing();
    std::vector<Packet> packets = transport_.poll();
    const bool is_busy = !packets.empty() || transport_.is_sending();
    for (Packet& packet : packets) deliver(std::move(packet));
    const double now = now_seconds();
    if (now - looked > 5 * kPulseSeconds) {  // this rank was not running
      watch_->forgive(now);
      if (now - looked > patience_ && size() > 1) given_up_until_ = now + kGraceSeconds;
    }
    looked = now;
    if (now >= pulse_due || pulse_wanted_.exchange(false)) {
      pulse_due = now + kPulseSeconds;
      send_pulse();
      look_at_others(now);
    }
    look_at_own_work();
    move_on(now);
    pause = is_busy ? kShortest : std::min(2 * pause, kLongest);
    std::unique_lock lock(mutex_);
    if (outgoing_.empty()) leaving_.wait_for(lock, pause);
  }
  while (transport_.is_sending()) transport_.poll();
}

void Ranks::take_outgoing() {
  std::deque<Packet> taken;
  {
    const std::lock_guard lock(mutex_);
    taken.swap(outgoing_);
  }
  for (Packet& packet : taken) transport_.send(packet.from, packet.tag, std::move(packet.bytes));
}

void Ranks::deliver(Packet packet) {
  watch_->heard(packet.from, now_seconds());
  if (packet.tag == static_cast<int>(Tag::kControl)) return control(packet);
  const std::lock_guard lock(mutex_);
  mailbox_[static_cast<Tag>(packet.tag)].push_back(std::move(packet));
  arrived_.notify_all();
}

void Ranks::control(const Packet& packet) {
  ByteReader bytes(packet.bytes);
  switch (static_cast<Word>(bytes.number())) {
    case Word::kPulse: {
      const bool is_working = bytes.number() != 0;
      const Pulse pulse = {is_working, bytes.number()};
      if (rank() == 0) watch_->pulse(packet.from, pulse, now_seconds());
      if (packet.from == 0)
        patience_ = 1e-3 * static_cast<double>(bytes.number());
      else
        hosts_[packet.from] = bytes.text();
      break;
    }
    case Word::kFailed: {
      const int code = static_cast<int>(bytes.number());
      decide({code, std::string(bytes.text())}, packet.from);
      break;
    }
    case Word::kStop:
      stop(static_cast<int>(bytes.number()));
      break;
    case Word::kStopped: {
      ++acknowledged_;
      totals_.traffic.bytes += bytes.number();
      totals_.traffic.messages += bytes.number();
      const double cpu = 1e-6 * static_cast<double>(bytes.number());
      totals_.cpu_seconds += cpu;
      totals_.longest_cpu_seconds = std::max(totals_.longest_cpu_seconds, cpu);
      break;
    }
    case Word::kLeave:
      state_ = State::kLeft;
      break;
  }
}

// Rank 0 sends its pulse to all ranks; the others send theirs to rank 0.
void Ranks::send_pulse() {
  const Pulse pulse = {working_ > 0, program_.progress() + done_};
  ByteWriter bytes;
  bytes.number(static_cast<std::uint64_t>(Word::kPulse))
      .number(pulse.is_working ? 1 : 0)
      .number(pulse.progress);
  if (rank() != 0) {
    transport_.send(0, static_cast<int>(Tag::kControl), bytes.text(transport_.host()).take());
    return;
  }
  watch_->pulse(0, pulse, now_seconds());
  const std::string text = bytes.number(static_cast<std::uint64_t>(1e3 * patience_)).take();
  for (int to = 1; to < size(); ++to) {
    transport_.send(to, static_cast<int>(Tag::kControl), text);
  }
}

// Rank 0 looks at all ranks. The others look at rank 0, each with more patience than the rank
// before.
void Ranks::look_at_others(double now) {
  if (rank() == 0) {
    if (state_ != State::kRunning) return;
    const auto found = watch_->look(now, patience_, 0);
    if (!found) return;
    const char* what =
        found->why == Watch::Why::kSilent ? "has not been heard of" : "has made no progress";
    decide({program_.failure,
            fmt::format("{} for {:.0f} s (--patience), and is ended", what, patience_.load())},
           found->rank);
    return;
  }
  const double patience = patience_ + 2 * kPulseSeconds + kAbortSeconds * (rank() - 1);
  if (!watch_->look(now, patience, rank(), 0)) return;
  // A rank is only asked to stop because another rank has printed a message already.
  if (program_.interrupted() == 0) {
    program_.error(
        of_rank(0, fmt::format("has not been heard of by rank {} for {:.0f} s (--patience)", rank(),
                               patience)));
  }
  code_ = program_.failure;
  abort();
}

void Ranks::look_at_own_work() {
  if (state_ != State::kRunning || has_told_) return;
  if (const int signal = program_.interrupted(); signal != 0) {
    return tell({128 + signal, "interrupted"});
  }
  std::unique_lock lock(mutex_);
  if (!own_ending_) return;
  const Ending ending = *own_ending_;
  lock.unlock();
  tell(ending);
}

void Ranks::tell(const Ending& ending) {
  has_told_ = true;
  if (rank() == 0) return decide(ending, 0);
  transport_.send(0, static_cast<int>(Tag::kControl),
                  ByteWriter()
                      .number(static_cast<std::uint64_t>(Word::kFailed))
                      .number(static_cast<std::uint64_t>(ending.code))
                      .text(ending.message)
                      .take());
}

// The first of several endings counts.
void Ranks::decide(const Ending& ending, int rank) {
  if (state_ != State::kRunning) return;
  if (!ending.message.empty() && now_seconds() > given_up_until_) {
    const bool is_of_all = ending.code == 2 || ending.code > 128;  // usage, signals
    program_.error(with_hint(is_of_all ? ending.message : of_rank(rank, ending.message)));
  }
  const std::string text = ByteWriter()
                               .number(static_cast<std::uint64_t>(Word::kStop))
                               .number(static_cast<std::uint64_t>(ending.code))
                               .take();
  for (int to = 1; to < size(); ++to) {
    transport_.send(to, static_cast<int>(Tag::kControl), text);
  }
  stop(ending.code);
}

void Ranks::stop(int code) {
  if (state_ != State::kRunning) return;
  state_ = State::kStopping;
  code_ = code;
  stopped_at_ = now_seconds();
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    arrived_.notify_all();
  }
  program_.stop(code);
}

// Rank 0 lets ranks leave only when no message is on its way: all have stopped and said so.
void Ranks::move_on(double now) {
  if (state_ == State::kRunning || state_ == State::kLeft) return;
  bool has_ended = false;
  {
    const std::lock_guard lock(mutex_);
    has_ended = has_ended_ && outgoing_.empty();
  }
  if (state_ == State::kStopping && has_ended && !transport_.is_sending()) {
    state_ = State::kAcknowledged;
    if (rank() != 0) {
      const Traffic traffic = transport_.traffic();
      transport_.send(0, static_cast<int>(Tag::kControl),
                      ByteWriter()
                          .number(static_cast<std::uint64_t>(Word::kStopped))
                          .number(traffic.bytes)
                          .number(traffic.messages)
                          .number(static_cast<std::uint64_t>(1e6 * cpu_seconds()))
                          .take());
    }
  }
  if (rank() != 0) return;
  if (state_ == State::kAcknowledged && acknowledged_ == size() - 1) {
    totals_.ranks = size();
    totals_.traffic.bytes += transport_.traffic().bytes;
    totals_.traffic.messages += transport_.traffic().messages;
    totals_.cpu_seconds += cpu_seconds();
    totals_.longest_cpu_seconds = std::max(totals_.longest_cpu_seconds, cpu_seconds());
    for (int to = 1; to < size(); ++to) {
      transport_.send(to, static_cast<int>(Tag::kControl), word(Word::kLeave));
    }
    state_ = State::kLeft;
    return;
  }
  const double grace = code_ == 0 ? std::max(kGraceSeconds, patience_.load()) : kGraceSeconds;
  if (now - stopped_at_ <= grace) return;
  if (code_ == 0) {
    program_.error(fmt::format("all is done, but {} of {} ranks do not end",
                               size() - 1 - acknowledged_, size()));
    code_ = program_.failure;
  }
  abort();
}

std::string Ranks::of_rank(int rank, const std::string& text) const {
  const auto host = hosts_.find(rank);
  if (rank != this->rank() && host == hosts_.end()) return fmt::format("rank {}: {}", rank, text);
  return fmt::format("rank {} on {}: {}", rank,
                     rank == this->rank() ? transport_.host() : host->second, text);
}

std::string Ranks::with_hint(const std::string& text) {
  const std::lock_guard lock(mutex_);
  const std::string hint = hint_ ? hint_() : "";
  return hint.empty() ? text : fmt::format("{}; {}", text, hint);
}

void Ranks::abort() {
  if (program_.discard) program_.discard();
  transport_.abort(code_);
}

}  // namespace rholm
