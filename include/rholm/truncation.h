// How far the surface of an expansion is from the mesh it was made of, and the degree that keeps a
// tolerance. Layer: transform.
//
// Radial errors are |r - r_L| along directions from the centre. Distances between the surfaces are
// those of closest points, both ways (method 5).
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

// How exact the coefficients are, and what is wanted.
struct TruncationOptions {
  // Relative error of the coefficients, l2 without the mean: decides whether Parseval's difference
  // of two large numbers still means something. By default that of the expansion, or if that is not
  // known 1e-8.
  std::optional<double> precision = {};
  bool predict = true;  // the largest errors in closed form; about 300 ns per triangle
};

// Their list (fields.h).
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

// All that can be known of a star-shaped closed mesh where it lies. `expansion` is that of the mesh
// about its centre, of the radius or the gauge. The rms is exact by Parseval where the coefficients
// are exact enough for that (then rms_is_exact), else measured. Throws InvalidInput as validate()
// does, and for a gauge with q_L <= 0.
TruncationErrors truncation_errors(const MeshView& mesh, const Expansion& expansion,
                                   const TruncationOptions& options = {},
                                   const Context& context = {});

// Which error of all those over the surface counts.
enum class ErrorNorm {
  kRms,  // root mean square
  kMax   // the largest
};
// Between what it is measured.
enum class ErrorMeasure {
  kRadius,   // rms over solid angle: exact, by Parseval
  kDistance  // rms over area, the larger of both ways
};
EnumNames names_of(ErrorNorm norm);        // "rms", "max"
EnumNames names_of(ErrorMeasure measure);  // "radius", "distance"

// What an error is given in.
enum class ToleranceUnit {
  kAbsolute,  // the mesh's own
  kDiagonal,  // of the bounding box
  kRadius     // mean over directions
};
EnumNames names_of(ToleranceUnit unit);  // "absolute", "diagonal", "radius"

// The largest error that is allowed.
struct Tolerance {
  double error = 0;                               // above 0
  ToleranceUnit unit = ToleranceUnit::kAbsolute;  // of `error`
  ErrorNorm norm = ErrorNorm::kRms;               // of all errors
  ErrorMeasure measure = ErrorMeasure::kRadius;   // of each
  int max_degree = 1024;                          // 0 ... kMaxDegree
};

// Their list (fields.h).
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
  // Of the smallest degree that keeps the tolerance, or of max_degree. The errors of its expansion
  // are set where the tolerance is one of the largest error or of distances: they were measured.
  Analysis analysis;
  double allowed = 0;        // in the mesh's unit
  double reached = 0;        // the error of that degree in the norm and measure of the tolerance
  bool met = false;          // reached <= allowed
  std::vector<int> degrees;  // that were computed on the way, the last one in full precision
};

// The smallest degree whose error is within the tolerance: of the radius exactly so, and the same
// for every max_degree; of distances no degree just below keeps it, but where they do not fall with
// every degree, one further below may. Coefficients of more degrees may be
// cut off. options.degree is not used; the precision is as fine as the tolerance asks for, and
// options.precision at most. Throws InvalidInput for a tolerance out of range, the method gauge,
// and a surface that is not star-shaped.
ToleranceAnalysis analyze(const StarChart& chart, const Tolerance& tolerance,
                          const AnalyzeOptions& options = {}, const Context& context = {});

}  // namespace rholm
