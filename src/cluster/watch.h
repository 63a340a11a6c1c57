// Whether ranks are alive, and get on. Layer: cluster, private. Knows no MPI and no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace rholm {

// What a rank says of itself every second.
struct Pulse {
  bool is_working = false;     // whether it has something to do
  std::uint64_t progress = 0;  // another number each time it has got on
};

// Seconds count from any beginning.
class Watch {
 public:
  Watch(int ranks, double now);
  // Any message of a rank, and its pulse.
  void heard(int rank, double now);
  void pulse(int rank, const Pulse& pulse, double now);

  // All are taken as heard now: who looks has been away itself.
  void forgive(double now);

  enum class Why { kSilent, kNoProgress };
  struct Finding {
    int rank = 0;
    Why why = Why::kSilent;
  };
  // The first rank that has been silent, or at the same work without progress, for `patience`.
  // `self` is not looked at for silence; with `only` no other rank than that is.
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
