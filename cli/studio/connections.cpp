#include "cli/studio/connections.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <iterator>

#include "rholm/error.h"

namespace rholm::cli {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostHead = std::size_t{32} << 10;  // bytes; chosen: browsers send one or two
constexpr auto kHeadTime = 10s;  // for the whole head; chosen: browsers send it at once
// Age from which a waiting connection makes room for a new one if too many wait. Chosen: pages have
// sent the whole head by then, even on a busy machine.
constexpr auto kLeastTime = 1s;

// Returns the end of the head, which is an empty line; npos if it has not arrived.
std::size_t end_of_head(std::string_view bytes) {
  const std::size_t at = bytes.find("\n\r\n");
  return at == std::string_view::npos ? at : at + 3;
}

// Returns "/a/b" for "GET /a/b HTTP/1.1".
std::string_view target_of(std::string_view head) {
  const std::string_view line = head.substr(0, head.find('\r'));
  const std::size_t begin = line.find(' ');
  if (begin == std::string_view::npos) return {};
  const std::string_view rest = line.substr(begin + 1);
  return rest.substr(0, rest.find(' '));
}

void hang_up(int socket) {
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
}

}  // namespace

Connections::Connections(Options options) : options_(std::move(options)) {
  if (::pipe2(wake_, O_CLOEXEC | O_NONBLOCK) != 0) {
    throw Error(ErrorCode::kIo, std::string("a pipe cannot be made: ") + std::strerror(errno));
  }
  threads_.emplace_back([this] { watch(); });
  for (std::size_t i = 0; i < options_.workers; ++i) threads_.emplace_back([this] { work(); });
}

Connections::~Connections() {
  close();
  for (const int end : wake_) ::close(end);
}

void Connections::add(int socket) {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [this] { return closing_ || !is_full(); });
  if (closing_) return hang_up(socket);
  waiting_.push_back({.socket = socket, .since = Clock::now(), .head = {}});
  // A full pipe wakes the thread as well.
  (void)!::write(wake_[1], "", 1);
}

void Connections::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    for (const Waiting& one : waiting_) hang_up(one.socket);
    for (const Waiting& one : ready_) hang_up(one.socket);
    waiting_.clear();
    ready_.clear();
    for (const int socket : served_) ::shutdown(socket, SHUT_RDWR);
    (void)!::write(wake_[1], "", 1);
    room_.notify_all();
    work_.notify_all();
  }
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void Connections::watch() {
  std::unique_lock lock(mutex_);
  while (!closing_) {
    std::vector<pollfd> polled = {{.fd = wake_[0], .events = POLLIN, .revents = 0}};
    for (const Waiting& one : waiting_) {
      polled.push_back({.fd = one.socket, .events = POLLIN, .revents = 0});
    }
    lock.unlock();
    constexpr int kPause = std::chrono::milliseconds(kLeastTime).count() / 4;
    (void)::poll(polled.data(), polled.size(), kPause);
    char woken[64];
    while (::read(wake_[0], woken, sizeof woken) > 0) {
    }
    lock.lock();
    if (closing_) return;
    // Connections that arrived since stand behind the polled ones.
    auto one = waiting_.begin();
    for (std::size_t i = 1; i < polled.size(); ++i) {
      const auto next = std::next(one);
      if (polled[i].revents != 0 && !look_at(*one)) waiting_.erase(one);
      one = next;
    }
    drop_late(Clock::now());
    if (!is_full()) room_.notify_all();
  }
}

bool Connections::look_at(Waiting& one) {
  char bytes[4096];
  for (;;) {
    const ssize_t n = ::recv(one.socket, bytes, sizeof bytes, MSG_DONTWAIT);
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) return true;
    if (n <= 0) break;
    const std::size_t seen = one.head.size() < 2 ? 0 : one.head.size() - 2;
    one.head.append(bytes, static_cast<std::size_t>(n));
    if (end_of_head(std::string_view(one.head).substr(seen)) == std::string_view::npos) {
      if (one.head.size() < kMostHead) continue;
      break;
    }
    if (options_.may_ask(target_of(one.head))) {
      ready_.push_back(std::move(one));
      work_.notify_one();
      return false;
    }
    // The answer fits into the system's buffer; otherwise it is dropped.
    (void)::send(one.socket, options_.refusal.data(), options_.refusal.size(),
                 MSG_DONTWAIT | MSG_NOSIGNAL);
    break;
  }
  hang_up(one.socket);
  return false;
}

void Connections::drop_late(Clock::time_point now) {
  while (!waiting_.empty()) {
    const auto age = now - waiting_.front().since;
    if (age < kHeadTime && !(is_crowded() && age >= kLeastTime)) return;
    hang_up(waiting_.front().socket);
    waiting_.pop_front();
  }
}

void Connections::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    work_.wait(lock, [this] { return closing_ || !ready_.empty(); });
    if (closing_) return;
    Waiting one = std::move(ready_.front());
    ready_.pop_front();
    served_.insert(one.socket);
    room_.notify_all();
    lock.unlock();
    options_.serve(one.socket, std::move(one.head));
    lock.lock();
    served_.erase(one.socket);
    hang_up(one.socket);
  }
}

}  // namespace rholm::cli
