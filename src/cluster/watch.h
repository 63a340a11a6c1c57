// Watches whether ranks live and progress. Layer: cluster, private. Uses no MPI and no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace rholm {

// Report of a rank about itself, sent every second.
struct Pulse {
  bool is_working = false;     // true while it has something to do
  std::uint64_t progress = 0;  // changes each time it makes progress
};

// Times are in seconds since any fixed moment.
class Watch {
 public:
  Watch(int ranks, double now);
  // Record the time of any message of a rank, and its pulse.
  void heard(int rank, double now);
  void pulse(int rank, const Pulse& pulse, double now);

  // Takes all ranks as heard now, because the watching rank itself was not running.
  void forgive(double now);

  enum class Why { kSilent, kNoProgress };
  struct Finding {
    int rank = 0;
    Why why = Why::kSilent;
  };
  // Returns the first rank that has been silent, or at the same work without progress, for longer
  // than `patience`. Silence of `self` does not count; if given, `only` is the one rank looked at.
  std::optional<Finding> look(double now, double patience, int self,
                              std::optional<int> only = {}) const;

 private:
  struct State {
    double heard, pulsed, moved;
    Pulse pulse;
  };
  std::vector<State> states_;
};

}  // namespace rholm
