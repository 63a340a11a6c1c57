// Ctrl-C and other signals that stop the program. Layer: cli.
//
// The first signal that asks to stop (SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1,
// SIGUSR2) stops the library at its next check: the progress callback, or the program's
// CancelScope. The second removes unfinished files and exits at once. The exit code is 128 + the
// signal. Blocking calls return with EINTR.
#pragma once

#include <cstdint>

namespace rholm::cli {

void install_signal_handlers();

// Returns the signal that asked to stop, or 0.
int interrupting_signal();

// Acts as if that signal had come, for programs with another way to stop. The first one counts.
void interrupt(int signal);

// Returns true if no signal has come: the check of the program's CancelScope and progress. Counts
// the checks, which continue as long as something is computed.
bool keep_going();
std::uint64_t questions_asked();
// For tests: simulates SIGINT just before check number `question`, starting at 1.
void interrupt_at(std::uint64_t question);

// Throws Error{kCancelled} after a signal. Called between the steps of a command, so that no output
// is started.
void stop_if_interrupted();

}  // namespace rholm::cli
