// Coefficients of a star chart. Layer: transform.
//
// Source: Mousa, Chaine, Akkouche, Galin 2007 ("the paper"), corrected and extended:
// docs/method.md, whose equations (M1)-(M8) are cited.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/harmonic.h"
#include "rholm/mesh_view.h"
#include "rholm/star.h"

namespace rholm {

// The function that is expanded, and the integrals that compute its coefficients.
enum class Method {
  kEdge,   // r by integrals over flat edges and faces, divided by l(l+1), (M6)
  kGauge,  // q = 1/r by integrals over the arcs of the edges alone, (M4)-(M5)
  kCurl,   // r by the paper's field, corrected, (M1)-(M3): slow, edges only
  kArea    // r by cubature of r dOmega over the faces
};
EnumNames names_of(Method method);  // "edge", "gauge", "curl", "area"

// Settings and errors of a run of the fast engine.
struct FastReport {
  bool single = false;           // true if sources were spread in single precision
  int width = 0;                 // number of grid points of the spreading window
  double oversampling = 0;       // oversampling factor of the grid
  std::size_t lumped_faces = 0;  // triangles represented by sources at their vertices
  std::size_t nodes = 0;         // number of sources that are not at vertices
  std::size_t vertices = 0;      // number of sources at vertices
  // l2 error over 1 <= l <= L, relative to the norm of the function without its mean.
  double error = 0;
  double band_error = 0;  // error of the degrees above 3L/4, relative to the norm of these degrees
  // Share of the triangles that both errors come from. 1: a second, finer pass over the rotated
  // mesh, as for small meshes. Below 1: rule errors come from a sample of a larger mesh (method
  // 3h). 0: both errors are estimates of the error model.
  double measured_share = 0;
  double error_uncertainty = 0;  // the true error may exceed the measured error by this much
  int passes = 0;                // number of passes over the triangles
  // True if the error, with its uncertainty, is within the wanted precision, or within the least
  // error that rounding allows.
  bool reached = true;
};

// Lists the fields of FastReport.
template <typename Visitor>
void visit_fields(FieldsOf<FastReport>, const Visitor& field) {
  using F = FastReport;
  field(&F::single, {.name = "single", .help = "true if sources were spread in single precision"});
  field(&F::width, {.name = "width", .help = "number of grid points of the spreading window"});
  field(&F::oversampling, {.name = "oversampling", .help = "oversampling factor of the grid"});
  field(&F::lumped_faces, {.name = "lumped_faces",
                           .help = "number of faces represented by sources at their vertices"});
  field(&F::nodes, {.name = "nodes", .help = "number of sources that are not at vertices"});
  field(&F::vertices, {.name = "vertices", .help = "number of sources at vertices"});
  field(&F::error, {.name = "error",
                    .help = "l2 error of the coefficients from degree 1 on, relative to the norm "
                            "of the function without its mean"});
  field(&F::band_error,
        {.name = "band_error",
         .help = "l2 error of the degrees above 3L/4, relative to the norm of these degrees"});
  field(&F::measured_share,
        {.name = "measured_share",
         .help = "share of the faces on which errors were measured; 1: a second, finer pass; less: "
                 "a sample; 0: errors are estimated"});
  field(&F::error_uncertainty, {.name = "error_uncertainty",
                                .help = "possible excess of the true error over a measured error"});
  field(&F::passes, {.name = "passes", .help = "number of passes over the faces"});
  field(&F::reached, {.name = "reached",
                      .help = "true if the error is within the precision, or within the least "
                              "error that rounding allows"});
}

// Degree, method and precision for expand().
struct TransformOptions {
  int degree = 64;                // L, 0 ... kMaxDegree
  Method method = Method::kEdge;  // kGauge expands 1/r, the others r
  // Engine for sums: the fast engine keeps the wanted precision, direct sums are the reference. The
  // methods curl and area always use direct sums.
  Engine engine = Engine::kFast;
  // Wanted error, 1e-14 ... 1e-1. For 1 <= l <= L: l2 norm of the error / norm of the function
  // without its mean. For c_00: relative to c_00. Rounding adds about 1e-15 c_00 times the largest
  // r / d_T.
  double precision = 1e-8;
};

// Lists the fields (fields.h) that TransformOptions and ExpandOptions of model.h have in common.
template <typename O, typename Visitor>
void visit_transform_fields(const Visitor& field) {
  field(&O::degree, {.name = "degree",
                     .help = "highest degree L; the model has (L+1)^2 coefficients",
                     .value = "L",
                     .least = 0,
                     .most = kMaxDegree,
                     .in_python = false});
  field(&O::method,
        {.name = "method",
         .help = "method of the integrals; gauge expands 1/r, the others the radius r"});
  field(&O::engine, {.name = "engine",
                     .help = "method of the sums; fast: on a grid, to the wanted precision; "
                             "direct: term by term, slow; curl and area always use direct sums"});
  field(&O::precision, {.name = "precision",
                        .help = "wanted l2 error of the coefficients, relative to the norm of the "
                                "function without its mean; finer where a tolerance needs it",
                        .value = "E",
                        .least = 1e-14,
                        .most = 0.1});
}
template <typename Visitor>
void visit_fields(FieldsOf<TransformOptions>, const Visitor& field) {
  visit_transform_fields<TransformOptions>(field);
}

// Coefficients, and how they were computed.
struct Transform {
  Expansion expansion;         // expansion with centre and method, and with norm and tail if known
  std::size_t edge_nodes = 0;  // number of quadrature nodes on edges
  std::size_t face_nodes = 0;  // number of quadrature nodes on faces
  // |sum_e s_e int_arc u ds| / sum_e |s_e| int_arc ds, (M5). It is zero for a closed, consistently
  // oriented mesh of any shape, so it checks mesh and orientation. Empty with the fast engine,
  // which checks both by a hash over all half-edges.
  std::optional<double> closure_residual;
  std::optional<FastReport> fast;  // set by the fast engine with the method edge
  // Precision that the coefficients were computed for. The search for a degree may use a finer
  // precision than TransformOptions::precision.
  double precision = 0;
  StageTimes times;  // stages "faces", "spread", "fourier", "verify", "norms"
  // Truncation error over solid angle, sqrt(||f - f_L||^2 / 4 pi), in the unit of f, and its
  // uncertainty. It is computed from the difference of the exact norm and the norm of the
  // coefficients, which are as exact as the precision. Empty if the uncertainty is not below an
  // eighth of the error (its square is then known to a quarter). Empty also if the surface is not
  // star-shaped: there (M7) is not the norm.
  std::optional<double> truncation_rms, truncation_rms_uncertainty;
};

// Lists the fields of Transform (fields.h), without the expansion.
template <typename Visitor>
void visit_fields(FieldsOf<Transform>, const Visitor& field) {
  using A = Transform;
  field(&A::edge_nodes, {.name = "edge_nodes", .help = "number of quadrature nodes on edges"});
  field(&A::face_nodes, {.name = "face_nodes", .help = "number of quadrature nodes on faces"});
  field(&A::closure_residual, {.name = "closure_residual",
                               .help = "closure error of the mesh, zero if it is closed and "
                                       "consistently oriented; None with the fast engine"});
  field(&A::fast,
        {.name = "fast", .help = "report of the fast engine, or None if it was not used"});
  field(&A::precision,
        {.name = "precision", .help = "precision that the coefficients were computed for"});
  field(&A::times,
        {.name = "times", .help = "wall and CPU time of each stage, in seconds: (wall, cpu)"});
  field(&A::truncation_rms, {.name = "truncation_rms",
                             .help = "root mean square truncation error over solid angle, in the "
                                     "unit of the function; None if too uncertain"});
  field(&A::truncation_rms_uncertainty,
        {.name = "truncation_rms_uncertainty",
         .help = "uncertainty of truncation_rms, from the precision of the coefficients"});
}

// Computes the coefficients of the surface by the chosen method. Throws InvalidInput for a degree
// or precision out of range, a centre on a vertex, or (gauge) a face seen edge on.
Transform expand(const StarChart& chart, const TransformOptions& options = {},
                 const Context& context = {});

// Return int r^2 dOmega and int q^2 dOmega of a star-shaped surface in closed form, (M7).
double radius_norm_squared(const StarChart& chart);
double gauge_norm_squared(const StarChart& chart);
double radius_norm_squared(const MeshView& mesh, const Vec3& center, const Context& context = {});

// Returns S = sum_e int_e (r^2 s_e)^2 ds for the radius, sum_e int_e s_e^2 ds for the gauge. The
// energy per degree is about S / (pi l^4) beyond the mesh's resolution, method 5.
double tail_strength(const StarChart& chart, RadialFunction function);
// Returns S of the radius for a closed mesh without a copy; identical vertices count as one. Takes
// 16 bytes of memory per half-edge whose opposite is far away in the order of the triangles.
double tail_strength(const MeshView& mesh, const Vec3& center, const Context& context = {});

// Largest truncation errors at vertices, times 2 pi (L + 1): the maximum over vertices of |sum of
// s_e over the edges that meet there|, times r^2 for the radius. The value is within 10 % of the
// largest error where L times the angle of the edges is above 10 (measured, L >= 64), and too large
// on finer meshes. Edges between saddle vertices may have larger errors than the vertices: 2 |s_e|
// r^2 instead of the sum.
struct ErrorStrengths {
  double radius = 0;  // strength for the radius, in the mesh's unit
  double gauge = 0;   // strength for 1/r, in 1/unit
  // For the distance between the surfaces: `radius` times cos gamma of the mean slope. A vertex
  // seen obliquely is rounded unevenly: the value is 16 % too small for a box with cos gamma = 0.6.
  double distance = 0;
};

// Lists the fields of ErrorStrengths.
template <typename Visitor>
void visit_fields(FieldsOf<ErrorStrengths>, const Visitor& field) {
  using E = ErrorStrengths;
  field(
      &E::radius,
      {.name = "radius",
       .help =
           "largest error of the radius at a vertex, times 2 pi (L + 1), in the unit of the mesh"});
  field(&E::gauge,
        {.name = "gauge",
         .help = "largest error of 1/r at a vertex, times 2 pi (L + 1), in 1/unit of the mesh"});
  field(&E::distance, {.name = "distance",
                       .help = "largest distance between the surfaces at a vertex, times 2 pi (L + "
                               "1), in the unit of the mesh"});
}
// Returns the strengths of a closed mesh without a copy; identical vertices count as one. Throws as
// validate(). Takes 12 bytes of memory per vertex for positions, 32 for sums.
ErrorStrengths vertex_error_strengths(const MeshView& mesh, const Vec3& center);
// Returns the strength of the radius or of the gauge alone.
double vertex_error_strength(const StarChart& chart, RadialFunction function);

}  // namespace rholm
