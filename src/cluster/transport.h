// Sends bytes from rank to rank by MPI. Layer: cluster, private. Only this file uses MPI.
//
// All calls come from the thread that made the object (MPI_THREAD_FUNNELED), and no call waits.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rholm {

struct Packet {
  int from = 0;
  int tag = 0;  // kind of message, for the receiver; >= 0
  std::string bytes;
};

// Traffic from a rank to the others: payloads, without heads.
struct Traffic {
  std::uint64_t bytes = 0;
  std::uint64_t messages = 0;
};

class Transport {
 public:
  // Begins MPI. A message is sent in pieces of at most `piece` bytes, because MPI counts by int.
  explicit Transport(std::size_t piece = std::size_t{1} << 30);
  // Ends MPI, which waits until all other ranks do the same. No message may be on its way.
  ~Transport();
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  int rank() const;
  int size() const;
  std::string host() const;
  // Returns this rank's share of the processors that it may use, at least 1: ranks on the same
  // machine share processors. Determined once, by all ranks at the same time.
  int processors() const;

  // Begins to send. Messages from one rank to another arrive in their order. Throws Io.
  void send(int to, int tag, std::string bytes);
  // Returns the messages that have arrived since the last call. Throws Io.
  std::vector<Packet> poll();
  bool is_sending() const;  // true while messages are on their way to others
  Traffic traffic() const;

  // Ends all ranks at once by MPI. They have no time to clean up.
  [[noreturn]] void abort(int code);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rholm
