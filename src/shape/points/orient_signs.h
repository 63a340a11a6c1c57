// Computes signs of normals and their confidence (method 7.12). Layer: shape.
#pragma once

#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/points.h"
#include "rholm/vec3.h"
#include "shape/points/normals.h"
#include "shape/points/orient_scene.h"
#include "shape/points/orient_sides.h"

namespace rholm {

// Normals, and how far the known facts agree with each, 0 ... 1; in the order of the scene.
struct OrientSigns {
  std::vector<Vec3> normals;
  std::vector<float> agreement = {};
};

// Uses the graph of neighbours if the winding number agrees with it, otherwise the field of all
// points. Directions in `given` that are not zero are kept; others may be replaced by fits to one
// sheet. Writes the number of components, and the neighbours of fits, to the report.
OrientSigns find_signs(const OrientScene& scene, std::span<const Vec3> given, LocalFits& fits,
                       OrientReport& report, const Context& context);

// Returns patches for fits whose disc is shared by fits.n_neighbors points. Patches wider by the
// factor `spread` smooth noise.
Patches patches_of(const LocalFits& fits, const SamplingGaps& gaps, double spread);
// Return the spread for fits of n_neighbors points, and for signs along the graph with them. The
// latter is 1 unless there is much noise.
double spread_of(int n_neighbors);
double spread_of_graph(int n_neighbors);

// Returns the confidence for an agreement: the sign is right with a probability of at
// least (1 + confidence) / 2.
double confidence_of(double agreement);

}  // namespace rholm
