// Truncation error at every degree of an expansion. Layer: transform.
#pragma once

#include <optional>
#include <vector>

#include "rholm/coefficients.h"

namespace rholm {

// Error made when an expansion is truncated at each of its degrees.
struct RmsBeyond {
  // Root mean square of f - f_l over solid angle, l = 0 ... L, in the function's unit, by Parseval
  // (M7). The last one is the truncation error of the expansion. Empty if its square is below four
  // times its uncertainty (otherwise the root is right to 13 %), and always empty without
  // norm_squared.
  std::vector<std::optional<double>> rms;
  // Root mean square of f_L - f_l: the content of the expansion's own degrees above l.
  std::vector<double> rms_within;
  // Uncertainty of 4 pi rms^2, from the coefficients' precision; empty without norm_squared. Known
  // errors take precedence: an exact error bounds it, and a measured error that differs from the
  // norm's shows the energy that the coefficients lack.
  std::optional<double> doubt;
  double precision = 0;               // the expansion's, or AnalyzeOptions' default
  bool precision_is_assumed = false;  // true if the expansion's precision is unknown
  // Returns true if rms includes degrees above the expansion's own, known from norm_squared.
  bool includes_tail() const { return doubt.has_value(); }
  // Returns the values to show for each degree: rms, or rms_within if norm_squared is missing. Then
  // the last degree has no value.
  std::vector<std::optional<double>> figures() const;
  // Returns true if rms of degree l is known and its square is at least 50 times its uncertainty:
  // right to a hundredth.
  bool is_exact(int l) const;
  // Returns an upper bound of rms where rms is empty; nothing without norm_squared.
  std::optional<double> bound() const;
  // Returns the smallest degree whose rms, or bound if rms is empty, is at most the tolerance.
  // Returns nothing if no degree is known to be.
  std::optional<int> degree_within(double tolerance) const;
};
// Computes the errors for every degree l of an expansion.
RmsBeyond rms_beyond(const Expansion& expansion);

}  // namespace rholm
