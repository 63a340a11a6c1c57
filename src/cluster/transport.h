// MPI: bytes from rank to rank. Layer: cluster, private. The one place that knows it.
//
// All calls come from the thread that made it (MPI_THREAD_FUNNELED), and none waits.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rholm {

struct Packet {
  int from = 0;
  int tag = 0;  // what it is, for the receiver; >= 0
  std::string bytes;
};

// What a rank has sent to others: payloads, without heads.
struct Traffic {
  std::uint64_t bytes = 0;
  std::uint64_t messages = 0;
};

class Transport {
 public:
  // Begins MPI. A message is sent in pieces of at most that many bytes; MPI counts by int.
  explicit Transport(std::size_t piece = std::size_t{1} << 30);
  // Ends MPI, which waits for all other ranks to do the same: not with messages on their way.
  ~Transport();
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  int rank() const;
  int size() const;
  std::string host() const;
  // Processors that this rank may use, shared with the ranks on the same machine that may use them
  // too: at least 1. Asked once, by all ranks at the same time.
  int processors() const;

  // Begins to send; messages from one rank to another arrive in their order. Throws Io.
  void send(int to, int tag, std::string bytes);
  // What has arrived since. Throws Io.
  std::vector<Packet> poll();
  bool is_sending() const;  // whether messages are on their way to others
  Traffic traffic() const;

  // Ends all ranks now, as MPI can; they have no time to clean up.
  [[noreturn]] void abort(int code);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rholm
