// Distance of the surface of an expansion from its mesh, and the degree that keeps a tolerance.
// Layer: transform.
//
// Radial errors are |r - r_L| along directions from the centre. Distances between the surfaces are
// to closest points, in both directions (method 5).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh_view.h"
#include "rholm/star.h"
#include "rholm/transform.h"

namespace rholm {

// Precision of the coefficients, and the errors to compute.
struct TruncationOptions {
  // Relative error of the coefficients, l2 without the mean. It decides whether Parseval's
  // difference of two large numbers is meaningful. By default the precision of the expansion, or
  // 1e-8 if that is unknown.
  std::optional<double> precision = {};
  bool predict = true;  // also predict largest errors in closed form; about 300 ns per face
};

// Lists the fields of TruncationOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<TruncationOptions>, const Visitor& field) {
  using O = TruncationOptions;
  field(&O::precision, {.name = "precision",
                        .help = "relative error of the coefficients; by default the precision of "
                                "the expansion, or 1e-8 if unknown",
                        .value = "E",
                        .least = 1e-14,
                        .most = 0.1,
                        .in_program = false});
  field(&O::predict, {.name = "predict",
                      .help = "also predict the largest errors in closed form",
                      .in_program = false});
}

// Computes all errors for a star-shaped closed mesh without copying it. `expansion` is the radius
// or the gauge of the mesh about its centre. The rms is exact by Parseval if the coefficients are
// exact enough (rms_is_exact), otherwise measured. Throws InvalidInput as validate(), and for a
// gauge with q_L <= 0.
TruncationErrors truncation_errors(const MeshView& mesh, const Expansion& expansion,
                                   const TruncationOptions& options = {},
                                   const Context& context = {});

// Ways to combine the errors over the surface.
enum class ErrorNorm {
  kRms,  // root mean square
  kMax   // largest
};
// Ways to measure the error at a place.
enum class ErrorMeasure {
  kRadius,   // radial, rms over solid angle: exact, by Parseval
  kDistance  // distance to the closest point, rms over area, the larger of both directions
};
EnumNames names_of(ErrorNorm norm);        // "rms", "max"
EnumNames names_of(ErrorMeasure measure);  // "radius", "distance"

// Unit of a tolerance.
enum class ToleranceUnit {
  kAbsolute,  // the mesh's own unit
  kDiagonal,  // diagonal of the bounding box
  kRadius     // mean radius over directions
};
EnumNames names_of(ToleranceUnit unit);  // "absolute", "diagonal", "radius"

// Largest allowed error.
struct Tolerance {
  double error = 0;                               // above 0
  ToleranceUnit unit = ToleranceUnit::kAbsolute;  // unit of `error`
  ErrorNorm norm = ErrorNorm::kRms;               // combination of the errors
  ErrorMeasure measure = ErrorMeasure::kRadius;   // measure of each error
  int max_degree = 1024;                          // largest degree tried, 0 ... kMaxDegree
};

// Lists the fields of Tolerance (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<Tolerance>, const Visitor& field) {
  using O = Tolerance;
  field(&O::error, {.name = "error",
                    .help = "largest allowed error of the model",
                    .value = "E",
                    .least = 0,
                    .above = true,
                    .in_program = false,
                    .in_python = false});
  field(&O::unit, {.name = "unit",
                   .help = "unit of the tolerance; absolute: unit of the shape; diagonal: diagonal "
                           "of the bounding box; radius: mean radius over directions"});
  field(&O::norm,
        {.name = "norm",
         .help = "norm of the error; rms: root mean square over the surface; max: largest error"});
  field(&O::measure,
        {.name = "measure",
         .help = "measure of the error; radius: along rays from the centre; distance: to the "
                 "closest point of the other surface, the default with --unit diagonal",
         .in_python = false});
  field(&O::max_degree, {.name = "max_degree",
                         .help = "highest degree tried to meet a tolerance",
                         .value = "L",
                         .least = 0,
                         .most = kMaxDegree});
}

// The degree for a tolerance, with its coefficients.
struct ToleranceTransform {
  // Transform of the smallest degree that keeps the tolerance, or of max_degree. For a tolerance on
  // the largest error or on distances, its expansion has measured errors.
  Transform transform;
  double allowed = 0;        // error in the mesh's unit
  double reached = 0;        // error of that degree, in the norm and measure of the tolerance
  bool met = false;          // reached <= allowed
  std::vector<int> degrees;  // computed degrees; the last one in full precision
};

// Finds the smallest degree within the tolerance. For the radius it is exact, and independent of
// max_degree. For distances no degree just below keeps the tolerance; a lower one may if distances
// do not fall with every degree. Coefficients may be truncated from a higher degree. options.degree
// is ignored; the precision is as fine as the tolerance needs, at most options.precision. Throws
// InvalidInput for a tolerance out of range, the method gauge, and a surface that is not
// star-shaped.
ToleranceTransform expand(const StarChart& chart, const Tolerance& tolerance,
                          const TransformOptions& options = {}, const Context& context = {});

}  // namespace rholm
