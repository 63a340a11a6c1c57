// Signs of normals, and what is known of them (method 7.12). Layer: shape.
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

// Normals, and how far what is known of each agrees with it, 0 ... 1; in the order of the scene.
struct OrientSigns {
  std::vector<Vec3> normals;
  std::vector<float> agreement = {};
};

// By the graph of neighbours where the winding number agrees with it, else by the field of all
// points. Directions that are not zero in `given` are kept; others may become those of fits to one
// sheet. Counts components in the report, and the neighbours of fits.
OrientSigns find_signs(const OrientScene& scene, std::span<const Vec3> given, LocalFits& fits,
                       OrientReport& report, const Context& context);

// So many points share the disc of a fit. Noise is seen through by patches that are `spread` times
// as coarse.
Patches patches_of(const LocalFits& fits, const SamplingGaps& gaps, double spread);
// For so many neighbours of a fit, and for signs along the graph with them: 1 unless there is much
// noise.
double spread_of(int n_neighbors);
double spread_of_graph(int n_neighbors);

// Of how far what is known of a normal agrees with it: its sign is right with a probability of
// (1 + confidence) / 2, or a larger one.
double confidence_of(double agreement);

}  // namespace rholm
