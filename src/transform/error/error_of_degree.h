// Measures the error of the first L degrees of coefficients, for any L, as a tolerance defines it.
#pragma once

#include <optional>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/truncation.h"
#include "transform/error/error_points.h"
#include "transform/error/error_sites.h"

namespace rholm {

// Returns sqrt(energy beyond l / 4 pi) for every degree l of the coefficients. `beyond` is the
// energy beyond all of their degrees.
std::vector<double> rms_tails(const Coefficients& coefficients, double beyond);
// Returns the smallest l whose tail is within the limit, or the last l if no tail is.
int smallest_degree(const std::vector<double>& tails, double limit);

// Returns the error that the tolerance limits.
double error_in(const TruncationErrors& errors, const Tolerance& tolerance);

// Measures errors and distances at points.
class ErrorOfDegree {
 public:
  // All arguments must outlive this object. `size` is the root mean square of the function.
  ErrorOfDegree(const Tolerance& tolerance, ErrorSites& sites, double size, const Context& context);

  // Returns the error of the first `degree` degrees at all points. Takes a part of the points if
  // they show that it is above or below the limit. A part is enough for root mean squares not close
  // to the limit. It is also enough if the largest error is above the limit or well within it at
  // former worst points, or far above it at the first degree. Near the limit, distances are to
  // closest points: of a sample or, where that is not enough and for coarse meshes, of trees.
  double of(const Expansion& expansion, int degree, double limit);

  // Returns points at which the largest error of some degree, or nearly the largest, was found.
  // They include points for each degree that was passed to of().
  const ErrorPoints& witnesses() const { return witnesses_; }

 private:
  bool is_distance() const { return tolerance_.measure == ErrorMeasure::kDistance; }
  bool is_largest() const { return tolerance_.norm == ErrorNorm::kMax; }
  bool may_be_refined(const Expansion& expansion, int degree, double limit);
  double closest_ratio(const Expansion& expansion, int degree, double limit);
  double closest_of(const Expansion& expansion, int degree, double limit);
  double witnessed_distance(const Expansion& expansion, int degree, double limit) const;
  double rms_of(const Expansion& expansion, int degree, double limit);
  double largest_of(const Expansion& expansion, int degree, double limit);
  double between_points(const Expansion& expansion, int degree, double limit,
                        const ErrorPoints& points, const std::vector<double>& errors);
  void witness(const ErrorPoints& points, const std::vector<double>& errors, int degree);
  void keep_worst(const ErrorPoints& points, const std::vector<double>& errors, double least);
  const ErrorPoints& all_points(int degree);
  const ErrorPoints& some_points();
  const ErrorPoints& few_points();
  double precision(double limit) const;
  PointErrors measured(const ErrorPoints& points, const Expansion& expansion, int degree,
                       double limit) const;
  std::vector<double> sizes(PointErrors errors) const;

  const Tolerance& tolerance_;
  ErrorSites& sites_;
  double size_;
  const Context& context_;
  Context silent_;
  ErrorPoints few_, some_, worst_, witnesses_;
  int degree_of_all_ = -1;
  int first_ = -1;
  bool closest_rule_ = false;  // true once this mesh is known to need closest points
};

// Returns the rms error of the radius at a part of the points over the area, to 0.7 %.
double sampled_rms(const Expansion& expansion, ErrorSites& sites, double precision,
                   const Context& context);

}  // namespace rholm
