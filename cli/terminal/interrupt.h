// Ctrl-C and its kin. Layer: cli.
//
// The first signal that asks to stop (SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1,
// SIGUSR2) stops the library at its next look (the progress callback, or the CancelScope of the
// program); the second removes unfinished files and leaves at once. The exit code is 128 + the
// signal. Blocking calls return with EINTR.
#pragma once

#include <cstdint>

namespace rholm::cli {

void install_signal_handlers();

// The signal that asked to stop, 0 if none did.
int interrupting_signal();

// As if that signal had come: for a program that is told to stop in another way. The first counts.
void interrupt(int signal);

// What a CancelScope and the progress of the program ask: whether no signal came. Counts the
// questions, which come as long as something is computed.
bool keep_going();
std::uint64_t questions_asked();
// For tests: SIGINT comes as if just before question number `question`, from 1.
void interrupt_at(std::uint64_t question);

// Throws Error{kCancelled} if one did: asked between the steps of a command, so that an output
// is not begun any more.
void stop_if_interrupted();

}  // namespace rholm::cli
