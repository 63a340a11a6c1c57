// Result of a mesh pass.
#pragma once

#include <cstddef>
#include <vector>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/transform.h"

namespace rholm {

struct MeshPassResult {
  Coefficients coefficients;  // of the radius; of the alternating sum if not star-shaped
  double volume = 0;          // enclosed volume; negative if inside out
  bool closed = false;        // every edge is used equally often both ways, by a hash
  double min_d = 0;
  double min_cos_gamma = 0;
  std::size_t bad_faces = 0;
  FastReport report;
  // Errors without the rules' part: l2 over 1 <= l <= L, and over the degrees above 3L/4.
  double error_beside = 0, band_error_beside = 0;
  std::vector<float> block_errors;  // of kTrianglesPerBlock faces, see MeshPart
  NonuniformPlan transform;         // the windows that were used
  double least_error = 0;           // least error by rounding, relative as FastReport::error
  StageTimes times;                 // "faces", "spread", "fourier"; "order" if faces were sorted
};

// Result of one pass through the faces.
enum class Outcome {
  kDone,
  kOutOfRange  // a vertex has left the range of its integers: double precision is needed
};

}  // namespace rholm
