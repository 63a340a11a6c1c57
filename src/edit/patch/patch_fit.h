// Fits of a patch's caps. Layer: edit.
#pragma once

#include <span>
#include <vector>

#include "atlas/cap/normal_equations.h"
#include "edit/patch/patch_cover.h"

namespace rholm {

// Coefficients of the fits of degree 0 ... cap.degree, one set after the other, each of
// patch_basis(cap.degree) numbers: a nested family of least squares.
struct PatchFit {
  std::vector<double> coefficients;
  double rejection = 0;  // distance along rays from which on points were rejected; 0 if none was
  bool solved = false;
};

// Scratch memory, one per thread. Points are worked on in blocks: `offsets` and `rows` as
// patch_kernels.h has them, one block after the other, rows of one block only.
struct PatchScratch {
  std::vector<double> offsets, rows, area, weights, base, matrix, solution, residual, order;
  NormalFactor factor;
  std::vector<std::uint32_t> taken;
  bool rows_made = false;  // of the only block
};

// Points marked as ignored are left out, if there are any marks.
PatchFit fit_patch_cap(const LocalMesh& local, const PatchCap& cap, bool robust,
                       std::span<const std::uint8_t> ignored, PatchScratch& scratch);

// phi = r / R_0 - 1 of the fit of each degree at the cap's points [first, first + n): values[d * n
// + i]; padded(n) points must fit into values' rows, whose length is `stride`.
void evaluate_patch_cap(const LocalMesh& local, const PatchCap& cap, const PatchFit& fit,
                        std::span<const std::uint32_t> points, PatchScratch& scratch,
                        double* values, std::size_t stride);

}  // namespace rholm
