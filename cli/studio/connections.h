// Connections from accept to close: admission of requests, and shutdown.
// Layer: cli.
//
// A connection waits until its request line and headers have arrived; no worker waits for it. The
// thread that watches all connections answers requests without the token, so that all workers are
// free for requests with the token.
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
    // Returns true if the target of a request line has the token; called by one thread.
    std::function<bool(std::string_view target)> may_ask;
    // The answer to all other requests, as bytes of HTTP.
    std::string refusal;
    // Answers a request; `head` holds the bytes read so far. Called by the workers. The socket is
    // closed afterwards.
    std::function<void(int socket, std::string head)> serve;
  };

  explicit Connections(Options options);
  ~Connections();
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  // Takes a socket; waits while there are too many. Closes it after close().
  void add(int socket);
  // Closes all connections, and waits for the workers, whose reads and writes end.
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
  // Returns true if the connection keeps waiting.
  bool look_at(Waiting& one);
  void drop_late(Clock::time_point now);
  bool is_full() const { return waiting_.size() + ready_.size() >= kMostWaiting; }

  // Only incomplete requests count: complete ones leave the queue on their own.
  bool is_crowded() const { return waiting_.size() >= kMostWaiting / 2; }

  static constexpr std::size_t kMostWaiting = 256;  // chosen: within a limit of 1024 files

  const Options options_;
  int wake_[2] = {-1, -1};
  std::mutex mutex_;  // protects all members below
  std::condition_variable room_, work_;
  std::list<Waiting> waiting_;  // oldest first
  std::deque<Waiting> ready_;
  std::set<int> served_;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace rholm::cli
