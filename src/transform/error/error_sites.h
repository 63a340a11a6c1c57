// Points at which the errors of a mesh are measured, and the errors that its edges predict. Each is
// made when it is first needed, and kept for the next measurement.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "rholm/analyze.h"
#include "rholm/mesh_view.h"
#include "rholm/truncation.h"
#include "transform/error/closest_distances.h"
#include "transform/error/error_points.h"
#include "transform/error/face_scan.h"

namespace rholm {

// Returns true if edges are so long against 1/L that the jumps across them predict the error. On
// finer meshes the jumps of neighbouring edges are correlated, and the prediction is too large.
bool shows_its_edges(const MeshView& mesh, int degree);

class ErrorSites {
 public:
  // The mesh must be valid and outlive the sites.
  ErrorSites(const MeshView& mesh, const Vec3& center, int threads = 1)
      : mesh_(mesh), center_(center), threads_(threads) {}
  // Takes the sizes that exact_norms() finds about this centre.
  ErrorSites(const MeshView& mesh, const Vec3& center, FaceSizes sizes, int threads)
      : mesh_(mesh), center_(center), threads_(threads), sizes_(std::move(sizes)) {}

  const MeshView& mesh() const { return mesh_; }
  const Vec3& center() const { return center_; }
  int threads() const { return threads_; }

  const FaceScan& scan();
  // Returns the vertices that belong to faces.
  const ErrorPoints& vertices();
  // Returns extreme_points() of the degree, then points over the area. Keeps the last result only.
  const ErrorPoints& all(int degree);
  // Returns 20 000 to 100 000 of area_points(), which give a root mean square to 0.3 %.
  const ErrorPoints& over_area();
  // Returns closest points: a few thousand or, if `fine`, the number that final results need.
  ClosestDistances& closest(bool fine);
  // Returns the largest errors at vertices times 2 pi (L + 1).
  const ErrorStrengths& strengths();

 private:
  MeshView mesh_;
  Vec3 center_;
  int threads_ = 1;
  std::optional<FaceSizes> sizes_;
  std::optional<FaceScan> scan_;
  std::optional<ErrorPoints> vertices_;
  std::optional<int> degree_;
  ErrorPoints all_;
  std::optional<ErrorPoints> over_area_;
  std::optional<ClosestDistances> few_, many_;
  std::optional<ErrorStrengths> strengths_;
};

// Does the same as the public function, for the mesh and the centre of the sites. On request it
// adds the points of the largest radial errors to `worst`.
TruncationErrors truncation_errors(const Expansion& expansion, const TruncationOptions& options,
                                   ErrorSites& sites, const Context& context,
                                   ErrorPoints* worst = nullptr);

}  // namespace rholm
