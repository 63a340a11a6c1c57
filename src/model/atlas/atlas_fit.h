// From chosen caps to a model whose extracted surface keeps a tolerance (method 7.8). Layer: model,
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

// What came of an aim: of an error of the samples' blend that is to make the surface just near
// enough.
struct AimOutcome {
  double reached = 0, rms = 0;  // of the samples' blend; of the surface
  std::size_t numbers = 0;      // of the model
  bool met = false;             // rms is at most what is accepted, which may be over the tolerance
  bool whole = true;            // parts and handles are the shape's
};

// The surface is a little farther from the shape than the samples' blend tells, and not by a steady
// factor: aims are corrected by what is measured, then halve (as logarithms) between one that keeps
// the tolerance and one that does not. A surface that is near enough and has other handles than the
// shape does not keep it: while none does, they are tried nearer.
class Aims {
 public:
  Aims(double tolerance, double first) : tolerance_(tolerance), aim_(first) {}
  double aim() const { return aim_; }
  // The aim that would end at the tolerance if the surface's rms were in proportion.
  double corrected(double rms) const;
  // Whether that is too little below the tolerance for another aim to spare numbers.
  bool is_close(double rms) const;
  // Whether a model of so many numbers is the last one again, whose handles were wrong.
  bool repeats(std::size_t numbers) const { return !last_.whole && numbers == last_.numbers; }
  // Goes on to the next aim; false if none promises more.
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

// How a closed surface hangs together.
struct Topology {
  std::size_t components = 0, genus = 0;
};
inline Topology topology_of(const Inspection& found) { return {found.components, found.genus}; }
// Parts and handles too many or too few; none where nothing is wanted.
std::size_t n_wrong_handles(const Topology& found, const std::optional<Topology>& wanted);

// More than these on a surface that is near enough are not mended by other aims:
// handles are seen as if by chance, and with h on one grid another has none in about exp(-h).
constexpr std::size_t kFewHandles = 3;

// Radii of supports over those that caps were chosen with, and the power of them that small ones
// override large ones by.
struct Overlap {
  double reach = 1, power = 1;
  bool settles = false;  // whether other handles than the shape's are put up with
};

// What a model is made for.
struct FitTarget {
  const SampleLevels& levels;
  std::optional<Topology> topology;  // of the shape, if it has one
  double tolerance = 0;              // that is aimed at
  double accepted = 0;               // that will do, at least as much
  double stray = 0;                  // caps' surfaces farther from all samples are cut back
  double step = 0;                   // of the grid
  int max_degree = 14;
  std::function<Mesh(const AtlasModel&)> surface;
  std::function<AtlasErrors(const Mesh&)> measure;
};

// Drops coefficients of the caps until the surface is as far from the shape as allowed; what is
// better than `result` replaces it. `aim` is where to begin, as far as it is known for the same
// caps (0: it is not), and is left for another overlap.
void fit_atlas(const FitTarget& target, const Atlas& chosen, const Overlap& overlap,
               Compressed& result, double& aim, const Context& context);

}  // namespace rholm
