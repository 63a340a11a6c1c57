// Fits the caps of a patch. Layer: edit.
#pragma once

#include <span>
#include <vector>

#include "atlas/cap/normal_equations.h"
#include "edit/patch/patch_cover.h"

namespace rholm {

// Coefficients of the fits of degree 0 ... cap.degree, a nested family of least
// squares. The sets follow each other; each has patch_basis(cap.degree) numbers.
struct PatchFit {
  std::vector<double> coefficients;
  double rejection = 0;  // distance along rays at which points were rejected; 0 if none
  bool solved = false;
};

// Scratch memory, one per thread. Points are processed in blocks: `offsets` and `rows`
// are as in patch_kernels.h, with one block after the other. `rows` has one block only.
struct PatchScratch {
  std::vector<double> offsets, rows, area, weights, base, matrix, solution, residual, order;
  NormalFactor factor;
  std::vector<std::uint32_t> taken;
  bool rows_made = false;  // rows of the only block
};

// Fits a cap; leaves out points marked in `ignored`, which may be empty.
PatchFit fit_patch_cap(const LocalMesh& local, const PatchCap& cap, bool robust,
                       std::span<const std::uint8_t> ignored, PatchScratch& scratch);

// Computes phi = r / R_0 - 1 of each degree d at points[i]: values[d * stride + i]. The
// rows of `values` have the length `stride`, which must be at least padded(points.size()).
void evaluate_patch_cap(const LocalMesh& local, const PatchCap& cap, const PatchFit& fit,
                        std::span<const std::uint32_t> points, PatchScratch& scratch,
                        double* values, std::size_t stride);

}  // namespace rholm
