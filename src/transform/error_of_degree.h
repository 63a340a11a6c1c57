// The error of the first L degrees of one set of coefficients, for any L, as a tolerance measures
// it.
#pragma once

#include <optional>
#include <vector>

#include "transform/degree_bracket.h"
#include "transform/error_points.h"
#include "transform/tolerance.h"

namespace rholm {

class ErrorOfDegree {
 public:
  // `final`: the coefficients are exact enough for Parseval, and all points are used. The largest
  // error at vertices, if it is known, is `at_vertices` / (L + 1); else 0.
  ErrorOfDegree(const ToleranceProblem& problem, const Tolerance& tolerance,
                const Expansion& expansion, bool final, double at_vertices, const Context& context);

  double of(int degree) const;

  // That of all coefficients, at all points.
  double reached() const;

  // An estimate of the smallest degree whose error is within the tolerance, that of the
  // coefficients being good; `bracket` says what is known.
  int estimate(const DegreeBracket& bracket) const;

  // The smallest good degree near an estimate, and its error; none if that of the coefficients is
  // not good either.
  std::optional<DegreeBracket> confirm(int estimate) const;

 private:
  // Known for all degrees from the energies.
  bool is_spectral() const;
  bool is_distance() const { return tolerance_.measure == ErrorMeasure::kDistance; }
  int degree() const { return expansion_.coefficients.degree(); }

  void set_tails();
  int smallest_spectral() const;
  std::optional<DegreeBracket> confirm_largest() const;
  DegreeBracket narrowed(const ErrorPoints& few, double factor, DegreeBracket bracket) const;

  PointErrors errors_of(const ErrorPoints& points, int degree) const;
  // Of all coefficients.
  const PointErrors& whole() const;
  double value_of(const PointErrors& errors) const;
  double measured(const ErrorPoints& points, int degree) const;
  ErrorPoints few_of(const ErrorPoints& points, const PointErrors& errors) const;

  const ToleranceProblem& problem_;
  const Tolerance& tolerance_;
  const Expansion& expansion_;
  bool final_;
  double at_vertices_;
  const Context& context_;
  Context silent_;
  std::vector<double> tails_;
  // Where the largest error is looked for, and where it is confirmed; else only the first.
  ErrorPoints points_, all_;
  mutable std::optional<PointErrors> whole_;
};

}  // namespace rholm
