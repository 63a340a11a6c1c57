#include "cluster/transport.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <list>
#include <thread>

// Leaves out the bindings for C++ that MPI 3 has dropped.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include "model/batch/row_bytes.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// A message has a head: the size of its bytes (8 bytes) and its tag (4 bytes). Up to kFew bytes
// follow in the head itself; more bytes follow in pieces.
constexpr int kHeadTag = 1, kPieceTag = 2;
constexpr std::size_t kHead = 12;
constexpr std::size_t kFew = 4096;  // chosen: all implementations send this without asking first

void check(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw Error(ErrorCode::kIo, fmt::format("MPI: {}: {}", what, text));
}

struct Outgoing {
  std::string head, bytes;
  std::vector<MPI_Request> requests;
};

struct Incoming {
  Packet packet;
  std::vector<MPI_Request> requests;
};

bool is_done(std::vector<MPI_Request>& requests, const char* what) {
  int done = 1;
  if (!requests.empty()) {
    check(
        MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE),
        what);
  }
  return done != 0;
}

// Calls `take` with the offset and size of each piece of `size` bytes.
template <typename Take>
void for_each_piece(std::size_t size, std::size_t piece, const Take& take) {
  for (std::size_t at = 0; at < size; at += piece) {
    take(at, static_cast<int>(std::min(piece, size - at)));
  }
}

// Returns the sum of this rank's shares of processors: one over the number of ranks that may use
// it.
int fair_share(MPI_Comm world) {
  MPI_Comm node = MPI_COMM_NULL;
  check(MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node), "ranks nearby");
  int n = 1;
  MPI_Comm_size(node, &n);
  cpu_set_t own;
  CPU_ZERO(&own);
  if (sched_getaffinity(0, sizeof(own), &own) != 0) CPU_SET(0, &own);
  std::vector<cpu_set_t> all(static_cast<std::size_t>(n));
  check(MPI_Allgather(&own, sizeof(own), MPI_BYTE, all.data(), sizeof(own), MPI_BYTE, node),
        "processors of ranks nearby");
  MPI_Comm_free(&node);
  double share = 0;
  for (std::size_t cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &own)) continue;
    const auto users = std::count_if(all.begin(), all.end(),
                                     [&](const cpu_set_t& s) { return CPU_ISSET(cpu, &s); });
    share += 1.0 / static_cast<double>(std::max<std::ptrdiff_t>(users, 1));
  }
  return std::max(1, static_cast<int>(share + 1e-9));
}

}  // namespace

struct Transport::State {
  MPI_Comm comm = MPI_COMM_NULL;
  std::size_t piece = 0;
  int rank = 0, size = 1, processors = 1;
  std::list<Outgoing> outgoing;
  std::vector<std::deque<Incoming>> incoming;  // messages of each rank, in their order
  std::vector<Packet> own;                     // messages to itself
  Traffic traffic;

  void receive_head(const MPI_Status& status);
  void take_what_is_whole(std::vector<Packet>& packets);
};

Transport::Transport(std::size_t piece) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.piece = std::min(piece, std::size_t{1} << 30);
  int provided = 0;
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "it does not begin");
  if (provided < MPI_THREAD_FUNNELED) {
    throw Error(ErrorCode::kUnsupported, "MPI: this one does not allow for threads");
  }
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "errors");
  check(MPI_Comm_dup(MPI_COMM_WORLD, &s.comm), "a communicator");
  check(MPI_Comm_set_errhandler(s.comm, MPI_ERRORS_RETURN), "errors");
  check(MPI_Comm_rank(s.comm, &s.rank), "rank");
  check(MPI_Comm_size(s.comm, &s.size), "size");
  s.incoming.resize(static_cast<std::size_t>(s.size));
  s.processors = fair_share(s.comm);
}

Transport::~Transport() {
  MPI_Comm_free(&state_->comm);
  MPI_Finalize();
}

int Transport::rank() const { return state_->rank; }
int Transport::size() const { return state_->size; }
int Transport::processors() const { return state_->processors; }
Traffic Transport::traffic() const { return state_->traffic; }
bool Transport::is_sending() const { return !state_->outgoing.empty() || !state_->own.empty(); }

std::string Transport::host() const {
  char name[MPI_MAX_PROCESSOR_NAME] = "";
  int length = 0;
  MPI_Get_processor_name(name, &length);
  return {name, static_cast<std::size_t>(length)};
}

void Transport::send(int to, int tag, std::string bytes) {
  State& s = *state_;
  if (to == s.rank) {
    s.own.push_back({to, tag, std::move(bytes)});
    return;
  }
  s.traffic.bytes += bytes.size();
  ++s.traffic.messages;
  Outgoing& message = s.outgoing.emplace_back();
  message.bytes = std::move(bytes);
  put_u64(message.head, message.bytes.size());
  put_u32(message.head, static_cast<std::uint32_t>(tag));
  const bool is_short = message.bytes.size() <= kFew;
  if (is_short) message.head += message.bytes;
  const auto begin = [&](const char* data, int size, int kind) {
    MPI_Request& request = message.requests.emplace_back(MPI_REQUEST_NULL);
    check(MPI_Isend(data, size, MPI_BYTE, to, kind, s.comm, &request), "a message is not sent");
  };
  begin(message.head.data(), static_cast<int>(message.head.size()), kHeadTag);
  if (is_short) return;
  for_each_piece(message.bytes.size(), s.piece, [&](std::size_t at, int size) {
    begin(message.bytes.data() + at, size, kPieceTag);
  });
}

void Transport::State::receive_head(const MPI_Status& status) {
  int count = 0;
  check(MPI_Get_count(&status, MPI_BYTE, &count), "a message has no size");
  std::string head(static_cast<std::size_t>(count), '\0');
  check(
      MPI_Recv(head.data(), count, MPI_BYTE, status.MPI_SOURCE, kHeadTag, comm, MPI_STATUS_IGNORE),
      "a message is not received");
  if (head.size() < kHead) throw Error(ErrorCode::kIo, "MPI: a message without a head");
  Incoming& message = incoming[static_cast<std::size_t>(status.MPI_SOURCE)].emplace_back();
  message.packet.from = status.MPI_SOURCE;
  message.packet.tag = static_cast<int>(get_u32(std::string_view(head).substr(8)));
  const std::uint64_t bytes = get_u64(head);
  if (bytes <= kFew) {
    message.packet.bytes = head.substr(kHead);
    return;
  }
  message.packet.bytes.resize(bytes);
  for_each_piece(bytes, piece, [&](std::size_t at, int part) {
    MPI_Request& request = message.requests.emplace_back(MPI_REQUEST_NULL);
    check(MPI_Irecv(message.packet.bytes.data() + at, part, MPI_BYTE, status.MPI_SOURCE, kPieceTag,
                    comm, &request),
          "a message is not received");
  });
}

void Transport::State::take_what_is_whole(std::vector<Packet>& packets) {
  for (std::deque<Incoming>& queue : incoming) {
    while (!queue.empty() && is_done(queue.front().requests, "a message is not received")) {
      packets.push_back(std::move(queue.front().packet));
      queue.pop_front();
    }
  }
}

std::vector<Packet> Transport::poll() {
  State& s = *state_;
  std::vector<Packet> packets = std::exchange(s.own, {});
  for (int here = 1; here != 0;) {
    MPI_Status status;
    check(MPI_Iprobe(MPI_ANY_SOURCE, kHeadTag, s.comm, &here, &status), "no connection");
    if (here != 0) s.receive_head(status);
  }
  s.take_what_is_whole(packets);
  s.outgoing.remove_if(
      [](Outgoing& message) { return is_done(message.requests, "a message is not sent"); });
  return packets;
}

void Transport::abort(int code) {
  // MPICH waits in MPI_Abort() for a rank that does not run. The program that started the ranks
  // ends all of them when one has left.
  std::thread([code] {
    std::this_thread::sleep_for(std::chrono::seconds(3));
    _exit(code);
  }).detach();
  MPI_Abort(state_->comm, code);
  _exit(code);
}

}  // namespace rholm
