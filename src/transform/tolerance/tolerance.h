// Degree and precision of coefficients for a tolerance, for meshes in charts and in place. search.h
// finds the degree that keeps the tolerance.
#pragma once

#include <functional>

#include "rholm/mesh_view.h"
#include "rholm/star.h"
#include "rholm/truncation.h"
#include "transform/norms/exact_norms.h"

namespace rholm {

// Largest number of faces of a mesh whose errors are predicted. Beyond, the edges take too long,
// and are mostly so short that their jumps do not predict the error (method 5).
inline constexpr std::size_t kMostPredicted = std::size_t{1} << 18;

// Degree and precision of the wanted coefficients.
struct TransformTarget {
  int degree = 0;
  double precision = 0;  // as in TransformOptions
};
// Computes coefficients of the mesh about the centre, without norms.
using TransformTo = std::function<Transform(const TransformTarget&)>;

struct ToleranceProblem {
  MeshView mesh;
  Vec3 center;
  double norm_squared = 0;       // squared norm of the radius
  double diagonal = 0;           // diagonal of the bounding box
  double precision = 0;          // precision that the caller needs at least
  TransformTo pilot, transform;  // fast coarse coefficients; final coefficients
};
// Returns all but the transforms. The mesh must outlive the result.
ToleranceProblem tolerance_problem(const MeshView& mesh, const Vec3& center,
                                   const ExactNorms& norms, double precision,
                                   const Context& context);

// Throws InvalidInput for values out of range.
void check(const Tolerance& tolerance);
// Throws InvalidInput for a surface that is not star-shaped: no tolerance can be kept.
void require_one_sheet(const StarReport& star);

// Returns the first degree to try: coefficients are as cheap as the pass over the faces.
int first_degree(std::size_t n_faces, const Tolerance& tolerance);

// Returns the tolerance in the mesh's unit. `mean` is the mean radius.
double absolute_tolerance(const ToleranceProblem& problem, const Tolerance& tolerance, double mean);

// Precisions of coefficients: for an estimate of the degree, and for the result.
struct Precisions {
  double pilot = 0, final = 0;
};
Precisions precisions_for(const ToleranceProblem& problem, const Tolerance& tolerance);

// Returns the degree and precision of the first coefficients to compute.
TransformTarget first_pilot(const ToleranceProblem& problem, const Tolerance& tolerance);

}  // namespace rholm
