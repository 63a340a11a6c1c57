// Connections from their beginning to their end: who may come in, and what becomes of them when all
// ends. Layer: cli.
//
// A connection waits until its request line and headers are there; no worker waits for it. A
// request without the token is answered by the thread that waits for all connections, so that all
// workers are there for requests with the token.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace rholm::cli {

class Connections {
 public:
  struct Options {
    std::size_t workers = 1;
    // Whether the target of a request line has the token; called by one thread.
    std::function<bool(std::string_view target)> may_ask;
    // The answer to all others, bytes of HTTP.
    std::string refusal;
    // Answers; `head` are the bytes that have been read. Called by the workers. The socket is
    // closed afterwards.
    std::function<void(int socket, std::string head)> serve;
  };

  explicit Connections(Options options);
  ~Connections();
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  // Takes a socket; waits while there are too many. Closes it if all has ended.
  void add(int socket);
  // Hangs up on everybody, and waits for the workers, whose reads and writes end.
  void close();

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    int socket = -1;
    Clock::time_point since;
    std::string head;
  };

  void watch();
  void work();
  // Whether it waits on.
  bool look_at(Waiting& one);
  void drop_late(Clock::time_point now);
  bool is_full() const { return waiting_.size() + ready_.size() >= kMostWaiting; }

  // Requests that are ready make room by themselves.
  bool is_crowded() const { return waiting_.size() >= kMostWaiting / 2; }

  static constexpr std::size_t kMostWaiting = 256;  // chosen: what a limit of 1024 files allows

  const Options options_;
  int wake_[2] = {-1, -1};
  std::mutex mutex_;  // of all that follows
  std::condition_variable room_, work_;
  std::list<Waiting> waiting_;  // oldest first
  std::deque<Waiting> ready_;
  std::set<int> served_;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace rholm::cli
