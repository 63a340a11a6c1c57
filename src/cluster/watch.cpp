#include "cluster/watch.h"

namespace rholm {

Watch::Watch(int ranks, double now)
    : states_(static_cast<std::size_t>(ranks),
              State{.heard = now, .pulsed = now, .moved = now, .pulse = {}}) {}

void Watch::heard(int rank, double now) { states_[static_cast<std::size_t>(rank)].heard = now; }

void Watch::pulse(int rank, const Pulse& pulse, double now) {
  State& state = states_[static_cast<std::size_t>(rank)];
  const bool is_same =
      state.pulse.is_working && pulse.is_working && state.pulse.progress == pulse.progress;
  if (!is_same) state.moved = now;
  state.pulse = pulse;
  state.heard = state.pulsed = now;
}

void Watch::forgive(double now) {
  for (State& state : states_) state.heard = state.moved = now;
}

std::optional<Watch::Finding> Watch::look(double now, double patience, int self,
                                          std::optional<int> only) const {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const int rank = static_cast<int>(i);
    const State& state = states_[i];
    if (only && rank != *only) continue;
    if (rank != self && now - state.heard > patience) return Finding{rank, Why::kSilent};
    // The last pulse decides here: nobody knows whether a silent rank makes progress.
    if (state.pulse.is_working && state.pulsed - state.moved > patience) {
      return Finding{rank, Why::kNoProgress};
    }
  }
  return std::nullopt;
}

}  // namespace rholm
