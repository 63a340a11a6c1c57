// Fits a model of caps whose extracted surface keeps a tolerance (method 7.8). Layer: model,
// private.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

#include "atlas/compress/cap_samples.h"
#include "rholm/compress.h"
#include "rholm/topology.h"

namespace rholm {

// Result of an aim, which is the error allowed for the blend of the samples so that the surface
// just keeps the tolerance.
struct AimOutcome {
  double reached = 0, rms = 0;  // errors of the samples' blend and of the surface
  std::size_t numbers = 0;      // size of the model
  bool met = false;             // rms is at most the accepted error, which may exceed the tolerance
  bool whole = true;            // parts and handles are the shape's
};

// The error of the surface is slightly larger than the error of the samples' blend, by a varying
// factor. Aims are corrected by the measured error, then bisect (as logarithms) between an aim that
// keeps the tolerance and one that exceeds it. A surface with other handles than the shape does not
// keep it: smaller aims are tried until one has the right handles.
class Aims {
 public:
  Aims(double tolerance, double first) : tolerance_(tolerance), aim_(first) {}
  double aim() const { return aim_; }
  // Returns the aim that would reach the tolerance if the surface's rms were proportional to it.
  double corrected(double rms) const;
  // Returns true if rms is so close to the tolerance that another aim saves too few numbers.
  bool is_close(double rms) const;
  // Returns true if a model of this size repeats the last model, whose handles were wrong.
  bool repeats(std::size_t numbers) const { return !last_.whole && numbers == last_.numbers; }
  // Goes on to the next aim; returns false if no aim promises an improvement.
  bool advance(const AimOutcome& outcome);

 private:
  bool is_stalled(const AimOutcome& outcome) const;
  void remember(const AimOutcome& outcome);

  double tolerance_, aim_, last_aim_ = 0;
  AimOutcome last_;
  double kept_ = 0, missed_ = INFINITY;  // aims
  std::size_t kept_numbers_ = 0, missed_numbers_ = 0;
  int tightened_ = 0;
};

// The topology of a closed surface.
struct Topology {
  std::size_t components = 0, genus = 0;
};
inline Topology topology_of(const Inspection& found) { return {found.components, found.genus}; }
// Returns the number of surplus and missing parts and handles; 0 if no topology is wanted.
std::size_t n_wrong_handles(const Topology& found, const std::optional<Topology>& wanted);

// Other aims do not remove more handles than this from an accurate surface. Handles appear almost
// at random: with h on one grid, another grid has none with a probability of about exp(-h).
constexpr std::size_t kFewHandles = 3;

// `reach` is the ratio of the support radii to the radii at the choice of caps. `power` controls
// how strongly small caps override large ones.
struct Overlap {
  double reach = 1, power = 1;
  bool settles = false;  // true if other handles than the shape's are accepted
};

// The requirements for a model.
struct FitTarget {
  const SampleLevels& levels;
  std::optional<Topology> topology;  // topology of the shape, if it has one
  double tolerance = 0;              // the wanted error
  double accepted = 0;               // the accepted error, at least the tolerance
  double stray = 0;                  // cap surfaces farther from all samples are cut back
  double step = 0;                   // step of the grid
  int max_degree = 14;
  std::function<Mesh(const AtlasModel&)> surface;
  std::function<AtlasErrors(const Mesh&)> measure;
};

// Drops coefficients of the caps until the surface has the allowed distance from the shape; a model
// that is better than `result` replaces it. `aim` is the first aim, if known for the same caps (0:
// unknown), and on return the first aim for another overlap.
void fit_atlas(const FitTarget& target, const Atlas& chosen, const Overlap& overlap,
               Compressed& result, double& aim, const Context& context);

}  // namespace rholm
