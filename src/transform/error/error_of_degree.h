// The error of the first L degrees of coefficients, for any L, as a tolerance measures it.
#pragma once

#include <optional>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/truncation.h"
#include "transform/error/error_points.h"
#include "transform/error/error_sites.h"

namespace rholm {

// sqrt(sum of the energies beyond l / 4 pi) for every l of the coefficients, `beyond` being the
// energy beyond all of them.
std::vector<double> rms_tails(const Coefficients& coefficients, double beyond);
// The smallest l that has such a tail within the limit, the last one if none has.
int smallest_degree(const std::vector<double>& tails, double limit);

// The one that the tolerance is about.
double error_in(const TruncationErrors& errors, const Tolerance& tolerance);

// Largest errors and distances, measured at points.
class ErrorOfDegree {
 public:
  // All must outlive this. `size`: of the function, root mean square.
  ErrorOfDegree(const Tolerance& tolerance, ErrorSites& sites, double size, const Context& context);

  // Of the first `degree` degrees, at all points; at a part of them where these say on which side
  // of the limit it is: root mean squares that are not close to it, largest errors above it or well
  // within it at what were the worst points, or far above it at the first degree that is asked for.
  // Distances near the limit are those of closest points: of a sample, or of trees for coarse
  // meshes and from where a sample is not enough.
  double of(const Expansion& expansion, int degree, double limit);

  // Points at which the largest error of some degree was found, or almost so: of each degree that
  // of() was asked for.
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
  bool closest_rule_ = false;  // for this mesh, once it is known
};

// The root mean square error of the radius at a part of the points over the area, to 0.7 %.
double sampled_rms(const Expansion& expansion, ErrorSites& sites, double precision,
                   const Context& context);

}  // namespace rholm
