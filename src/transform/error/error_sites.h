// Where the errors of a mesh are looked for, and what its edges predict of them: each made when it
// is first asked for, and kept for the next measurement.
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

// Whether edges are so long against 1/L that the jumps across them predict the error; on finer
// meshes those of neighbouring edges are correlated, and what they predict is too large.
bool shows_its_edges(const MeshView& mesh, int degree);

class ErrorSites {
 public:
  // The mesh must be valid and outlive the sites.
  ErrorSites(const MeshView& mesh, const Vec3& center, int threads = 1)
      : mesh_(mesh), center_(center), threads_(threads) {}
  // Sizes as exact_norms() finds them about this centre.
  ErrorSites(const MeshView& mesh, const Vec3& center, FaceSizes sizes, int threads)
      : mesh_(mesh), center_(center), threads_(threads), sizes_(std::move(sizes)) {}

  const MeshView& mesh() const { return mesh_; }
  const Vec3& center() const { return center_; }
  int threads() const { return threads_; }

  const FaceScan& scan();
  // That belong to faces.
  const ErrorPoints& vertices();
  // extreme_points() of the degree, then those over the area; the ones asked for last are kept.
  const ErrorPoints& all(int degree);
  // 20 000 to 100 000 of area_points(): a root mean square to 0.3 %.
  const ErrorPoints& over_area();
  // Closest points: a few thousand, and as many as what is said in the end rests on.
  ClosestDistances& closest(bool fine);
  // Largest errors at vertices times 2 pi (L + 1).
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

// As the public function, of the mesh and about the centre of the sites. On request the points of
// the largest radial errors are added to `worst`.
TruncationErrors truncation_errors(const Expansion& expansion, const TruncationOptions& options,
                                   ErrorSites& sites, const Context& context,
                                   ErrorPoints* worst = nullptr);

}  // namespace rholm
