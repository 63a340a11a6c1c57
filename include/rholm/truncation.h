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

#include "rholm/analyze.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh_view.h"
#include "rholm/star.h"

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
                        .help = "how exact the coefficients are; by default as the expansion says",
                        .value = "E",
                        .least = 1e-14,
                        .most = 0.1,
                        .in_program = false});
  field(&O::predict, {.name = "predict",
                      .help = "whether the largest errors are predicted in closed form, too",
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
                    .help = "the largest error that is allowed",
                    .value = "E",
                    .least = 0,
                    .above = true,
                    .in_program = false,
                    .in_python = false});
  field(&O::unit, {.name = "unit",
                   .help = "of the tolerance: absolute, the shape's own; diagonal, of its bounding "
                           "box; radius, its mean over directions"});
  field(&O::norm, {.name = "norm",
                   .help = "of the tolerance: rms, the root mean square; max, the largest error"});
  field(&O::measure,
        {.name = "measure",
         .help = "of the tolerance: radius, along rays from the centre; distance, between the "
                 "surfaces, which unit diagonal takes where nothing is said",
         .in_python = false});
  field(&O::max_degree, {.name = "max_degree",
                         .help = "the largest degree that is tried for a tolerance",
                         .value = "L",
                         .least = 0,
                         .most = kMaxDegree});
}

// The degree for a tolerance, with its coefficients.
struct ToleranceAnalysis {
  // Analysis of the smallest degree that keeps the tolerance, or of max_degree. For a tolerance on
  // the largest error or on distances, its expansion has measured errors.
  Analysis analysis;
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
ToleranceAnalysis analyze(const StarChart& chart, const Tolerance& tolerance,
                          const AnalyzeOptions& options = {}, const Context& context = {});

}  // namespace rholm
