#include "cli/terminal/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <limits>

#include "rholm/error.h"
#include "rholm/file.h"

namespace rholm::cli {
namespace {

std::atomic<int> caught_signal = 0;
std::atomic<std::uint64_t> questions = 0;
std::atomic<std::uint64_t> last_question = std::numeric_limits<std::uint64_t>::max();
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

// Exits with the code that shells use: 128 + signal, 130 for SIGINT.
void on_stop(int signal) {
  if (caught_signal.exchange(signal) == 0) return;
  discard_unfinished_files();
  _exit(128 + signal);
}

// Ends silently if the reader of a pipe has gone (rholm ... | head), and removes unfinished files.
void on_broken_pipe(int signal) {
  discard_unfinished_files();
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

// Installs a handler without SA_RESTART, so that a read from a terminal or a pipe ends. A signal
// that the parent ignores (nohup, a background job) stays ignored.
void install(int signal, void (*handler)(int)) {
  struct sigaction old = {};
  if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler == SIG_IGN) return;
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void install_signal_handlers() {
  // Signals that users, schedulers and limits of processor time send to end a program.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2}) {
    install(signal, on_stop);
  }
  install(SIGPIPE, on_broken_pipe);
  // A write beyond the limit of file sizes fails as on a full disk.
  install(SIGXFSZ, SIG_IGN);
}

int interrupting_signal() { return caught_signal.load(); }

void interrupt(int signal) {
  int none = 0;
  caught_signal.compare_exchange_strong(none, signal);
}

bool keep_going() {
  if (questions.fetch_add(1, std::memory_order_relaxed) + 1 >= last_question) interrupt(SIGINT);
  return interrupting_signal() == 0;
}

std::uint64_t questions_asked() { return questions.load(std::memory_order_relaxed); }

void interrupt_at(std::uint64_t question) { last_question = question; }

void stop_if_interrupted() {
  if (interrupting_signal() != 0) throw Error(ErrorCode::kCancelled, "interrupted");
}

}  // namespace rholm::cli
