// From chosen caps to a model whose extracted surface keeps a tolerance (method 7.8). Layer: model,
// private.
#pragma once

#include <functional>
#include <optional>

#include "atlas/compress/cap_samples.h"
#include "rholm/compress.h"
#include "rholm/topology.h"

namespace rholm {

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
