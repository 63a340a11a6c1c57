#include "transform/mesh_pass/pass_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "harmonic/nonuniform/window_error.h"
#include "transform/mesh_pass/plan/error_budget.h"

namespace rholm {

// The weights of each face add up to zero. A sum that does not is out of the integers' range.
template <typename T>
void PassSums<T>::add(const MeshPart<T>& part, bool lumps_in_common) {
  const double weight =
      part.lumps.weight + part.border_weight + plan_.block.per_weight * part.weight;
  if (lumps_in_common) {
    weight_beside_common_ += weight;
  } else if (sizeof(T) == 4 && std::abs(weight) > 0x1p31) {
    out_of_range_ = true;
  }
  whole_.sums.add(part.sums);
  whole_.mean += part.mean;
  whole_.half_edges.insert(whole_.half_edges.end(), part.half_edges.begin(), part.half_edges.end());
  whole_.block_errors.insert(whole_.block_errors.end(), part.block_errors.begin(),
                             part.block_errors.end());
  whole_.modulus += part.modulus;
  whole_.nodes += part.nodes;
  whole_.node_error2 += part.node_error2;
  whole_.lumps.add(part.lumps);
  whole_.border_weight += part.border_weight;
  border_sums_.add(part.border);
  if (part.undivided.degree() != plan_.divided.degree) return;
  if (whole_.undivided.degree() != part.undivided.degree()) {
    whole_.undivided = Coefficients(part.undivided.degree());
  }
  for (std::size_t i = 0; i < part.undivided.values().size(); ++i) {
    whole_.undivided.values()[i] += part.undivided.values()[i];
  }
}

template <typename T>
BorderLumps<LumpOf<T>> PassSums<T>::take_border(const std::vector<IndexRange>& later,
                                                const PartWorker<T>& worker) {
  BorderLumps<LumpOf<T>> done =
      border_sums_.take([&](std::uint32_t vertex) { return !contains(later, vertex); });
  border_lumps_.add(worker.sums_of(done));
  return done;
}

template <typename T>
Outcome PassSums<T>::finish(const PartWorker<T>& worker) {
  if (!std::isfinite(whole_.sums.probe)) worker.refuse_mesh();
  border_ = &border_sums_.finish();
  border_lumps_.add(worker.sums_of(*border_));
  if (sizeof(T) == 4 && std::abs(border_lumps_.weight - whole_.border_weight) > 0x1p31) {
    out_of_range_ = true;
  }
  // Lumps in common are checked as one sum. Two vertices that leave the range in opposite ways are
  // not found, as within a part.
  if (sizeof(T) == 4 && std::abs(common_.weight + weight_beside_common_) > 0x1p31) {
    out_of_range_ = true;
  }
  if (out_of_range_) return Outcome::kOutOfRange;
  whole_.lumps.add(border_lumps_);
  whole_.lumps.add(common_);
  // Gradients count as they do in a window's error.
  const double weight = 1 / plan_.block.per_weight,
               slope = gradient_as_weight(plan_.divided.degree) / plan_.block.per_gradient;
  lumps2_ = weight * weight * whole_.lumps.weight2 + slope * slope * whole_.lumps.gradient2;
  return Outcome::kDone;
}

template <typename T>
void PassSums<T>::set_result(const MeshView& mesh, Coefficients sum, double source2,
                             double hessian2, const NonuniformPlan& transform,
                             MeshPassResult& result) {
  if (whole_.undivided.degree() == sum.degree()) {
    for (std::size_t i = 0; i < sum.values().size(); ++i) {
      sum.values()[i] += whole_.undivided.values()[i];
    }
  }
  const BlockSums& sums = whole_.sums;
  result.coefficients = std::move(sum);
  result.block_errors = std::move(whole_.block_errors);
  Coefficients& c = result.coefficients;
  c.c(0, 0) = (sums.mean + whole_.mean) / std::sqrt(4 * std::numbers::pi);
  const double unscale = 1 / plan_.block.scale;
  for (double& value : c.values()) value *= unscale;
  result.volume = sums.volume6 / 6 * unscale * unscale * unscale;
  result.closed = sums.hash1 == 0 && sums.hash2 == 0;
  const auto root = [](double x) { return std::copysign(std::sqrt(std::abs(x)), x); };
  result.min_d = root(sums.min_d2) * unscale;
  result.min_cos_gamma = root(sums.min_cos2);
  result.bad_faces = sums.bad;
  FastReport& report = result.report;
  report.nodes = whole_.nodes;
  report.single = sizeof(T) == 4;
  report.width = transform.fourier.layout.width;
  report.oversampling = static_cast<double>(transform.fourier.layout.n_phi) /
                        (2.0 * std::max(plan_.divided.degree, 1));
  report.lumped_faces = mesh.n_faces - sums.nodes;
  report.vertices = mesh.n_vertices;
  // With Hessians the grids have counted the vertices.
  set_error(mesh, source2 + (plan_.block.hessians ? 0 : lumps2_), hessian2, transform, result);
}

template <typename T>
void PassSums<T>::set_error(const MeshView& mesh, double source2, double hessian2,
                            const NonuniformPlan& transform, MeshPassResult& result) {
  PassFacts facts{.face_error2 = whole_.sums.face_error2,
                  .node_error2 = whole_.node_error2,
                  .node_modulus = whole_.modulus,
                  .half_edges = std::move(whole_.half_edges),
                  .source2 = source2,
                  .hessian2 = hessian2,
                  .vertices = mesh.n_vertices,
                  .transform = transform};
  const PassError error = error_of_pass(plan_, facts, result.coefficients);
  const int degree = plan_.divided.degree;
  const auto relative = [&](double absolute, int first) {
    const double norm = norm_of_degrees(result.coefficients, first, degree);
    return norm > 0 ? absolute / norm : 0.0;
  };
  result.error_beside = error.whole_beside;
  result.band_error_beside = error.band_beside;
  result.transform = transform;
  result.report.error = relative(error.whole, 1);
  result.report.band_error = relative(error.band, 3 * degree / 4 + 1);
}

template class PassSums<float>;
template class PassSums<double>;

}  // namespace rholm
