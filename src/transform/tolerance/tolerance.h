// What a tolerance asks of coefficients, for meshes in charts and where they lie: search.h finds
// the degree that keeps it.
#pragma once

#include <functional>

#include "rholm/mesh_view.h"
#include "rholm/star.h"
#include "rholm/truncation.h"
#include "transform/norms/exact_norms.h"

namespace rholm {

// Triangles of a mesh whose errors are predicted. Beyond, edges are too many to be kept waiting,
// and as a rule so short that their jumps say nothing of the error (method 5).
inline constexpr std::size_t kMostPredicted = std::size_t{1} << 18;

// What coefficients are to be.
struct TransformTarget {
  int degree = 0;
  double precision = 0;  // as in AnalyzeOptions
};
// Coefficients of the mesh about the centre, without norms.
using TransformTo = std::function<Analysis(const TransformTarget&)>;

struct ToleranceProblem {
  MeshView mesh;
  Vec3 center;
  double norm_squared = 0;       // of the radius
  double diagonal = 0;           // of the bounding box
  double precision = 0;          // wanted by the caller, at least
  TransformTo pilot, transform;  // coarse coefficients, as fast as can be; those that are wanted
};
// All but how to transform. The mesh must outlive it.
ToleranceProblem tolerance_problem(const MeshView& mesh, const Vec3& center,
                                   const ExactNorms& norms, double precision,
                                   const Context& context);

// Throws InvalidInput for values out of range.
void check(const Tolerance& tolerance);
// Throws InvalidInput for a surface that is not star-shaped: no tolerance can be kept.
void require_one_sheet(const StarReport& star);

// The degree to begin with: coefficients are as cheap as the pass over the faces.
int first_degree(std::size_t n_triangles, const Tolerance& tolerance);

// In the mesh's unit. `mean`: of the radius.
double absolute_tolerance(const ToleranceProblem& problem, const Tolerance& tolerance, double mean);

// How exact coefficients must be: for an estimate of the degree, and in the end.
struct Precisions {
  double pilot = 0, final = 0;
};
Precisions precisions_for(const ToleranceProblem& problem, const Tolerance& tolerance);

// The coefficients to begin with.
TransformTarget first_pilot(const ToleranceProblem& problem, const Tolerance& tolerance);

}  // namespace rholm
