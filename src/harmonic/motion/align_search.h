// The correlation of two functions over all rotations, on a grid of Euler angles.
//
//   <R a, b> = sum T_{m' h m} e^{-i (m' alpha + h beta + m gamma)}.
//   T_{m' h m} = i^{m'-m} sum_l conj(b_lm') a_lm Delta^l_{h m'} Delta^l_{h m}.
// This Fourier transform in three dimensions (Kovacs and Wriggers 2002) has complex coefficients
// with the Condon-Shortley phase.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/rotate.h"

namespace rholm {

// Returns rotations near the local maxima of the correlation over degrees 1 ... bandwidth, the
// largest first. There are at most `most`, no two within two steps of the grid.
std::vector<Rotation> correlation_peaks(const Coefficients& a, const Coefficients& b, int bandwidth,
                                        std::size_t most, const Context& context);

}  // namespace rholm
