// What is left out when an expansion is cut off. Layer: transform.
#pragma once

#include <optional>
#include <vector>

#include "rholm/coefficients.h"

namespace rholm {

// What is left out when an expansion is cut off at each of its degrees.
struct RmsBeyond {
  // Root mean square of f - f_l over solid angle, l = 0 ... L, in the function's unit, by Parseval
  // (M7); that of L is the truncation error of the expansion itself. Empty where it is not known:
  // where the square is below four times what it may be off by (elsewhere the root is right to
  // 13 %), and everywhere without norm_squared.
  std::vector<std::optional<double>> rms;
  // The same of f_L - f_l: what the expansion's own degrees above l hold.
  std::vector<double> rms_within;
  // What 4 pi rms^2 may be off by, as exact as the coefficients are; empty without norm_squared.
  // Where errors say otherwise they decide: an exact error bounds it, and a measured one that
  // differs from the norm's tells what the coefficients lack.
  std::optional<double> doubt;
  double precision = 0;               // the expansion's, or the default of AnalyzeOptions
  bool precision_is_assumed = false;  // whether the expansion's is not known
  // Whether it counts what lies above the expansion's own degree, which norm_squared tells.
  bool includes_tail() const { return doubt.has_value(); }
  // What there is to show of each degree: rms, or without norm_squared rms_within, but for the last
  // degree, of which it says nothing.
  std::vector<std::optional<double>> figures() const;
  // Whether rms of degree l is known, and its square is 50 times what it may be off by, or more:
  // right to a hundredth.
  bool is_exact(int l) const;
  // Where rms is empty, it is at most this; empty without norm_squared.
  std::optional<double> bound() const;
  // The smallest degree whose rms, or else its bound, is at most the tolerance; none if there is
  // none, or if it is not known.
  std::optional<int> degree_within(double tolerance) const;
};
// For every degree l of an expansion.
RmsBeyond rms_beyond(const Expansion& expansion);

}  // namespace rholm
