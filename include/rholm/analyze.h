// From a star chart to its coefficients. Layer: transform.
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

// Which function is expanded, and by which integrals.
enum class Method {
  kEdge,   // r by integrals over flat edges and faces, divided by l(l+1), (M6)
  kGauge,  // q = 1/r by integrals over the arcs of the edges alone, (M4)-(M5)
  kCurl,   // r by the paper's field, made right, (M1)-(M3): slow, edges only
  kArea    // r by cubature of r dOmega over the faces
};
EnumNames names_of(Method method);  // "edge", "gauge", "curl", "area"

// How the fast engine did it.
struct FastReport {
  bool single = false;               // sources spread in single precision
  int width = 0;                     // grid points of the window
  double oversampling = 0;           // of the grid
  std::size_t lumped_triangles = 0;  // whose sources are those of their vertices
  std::size_t nodes = 0;             // sources of their own
  std::size_t vertices = 0;          // sources at vertices
  // l2 over 1 <= l <= L, relative to the norm of the function without its mean.
  double error = 0;
  double band_error = 0;  // of the degrees above 3L/4 relative to that band's own norm
  // The part of the triangles that both errors come from. 1: all were read a second time, finer and
  // from another side, as small meshes are. Less: what rules leave comes from a sample of a larger
  // mesh (docs/performance.md says from where on). 0: they are estimates of the model.
  double measured_share = 0;
  double error_doubt = 0;  // of a measured error: by how much more it may be above it
  int passes = 0;          // over the triangles until the coefficients were found
  // Whether the error, with its doubt, is within the wanted precision, or within what rounding
  // leaves at best.
  bool reached = true;
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<FastReport>, const Visitor& field) {
  using F = FastReport;
  field(&F::single, {.name = "single", .help = "whether sources were spread in single precision"});
  field(&F::width, {.name = "width", .help = "grid points of the window"});
  field(&F::oversampling, {.name = "oversampling", .help = "of the grid"});
  field(&F::lumped_triangles, {.name = "lumped_triangles",
                               .help = "triangles whose sources are those of their vertices"});
  field(&F::nodes, {.name = "nodes", .help = "sources of their own"});
  field(&F::vertices, {.name = "vertices", .help = "sources at vertices"});
  field(&F::error,
        {.name = "error",
         .help =
             "of the coefficients, l2 over degrees from 1 on, relative to the norm without mean"});
  field(&F::band_error,
        {.name = "band_error", .help = "of the degrees above 3L/4 relative to their own norm"});
  field(&F::measured_share,
        {.name = "measured_share",
         .help = "part of the triangles that errors were measured on: 1 by a second, finer "
                 "reading, less on a sample; 0 where they are estimates"});
  field(&F::error_doubt,
        {.name = "error_doubt", .help = "by how much more a measured error may be off"});
  field(&F::passes,
        {.name = "passes", .help = "over the triangles until the coefficients were found"});
  field(&F::reached, {.name = "reached", .help = "whether the error is within the precision"});
}

// What is wanted of analyze(), and how.
struct AnalyzeOptions {
  int degree = 64;                // L, 0 ... kMaxDegree
  Method method = Method::kEdge;  // kGauge expands 1/r, the others r
  // How sums are done: fast ones keep the wanted precision, direct ones are the oracle. The methods
  // curl and area are always direct.
  Engine engine = Engine::kFast;
  // Wanted error of the coefficients 1 <= l <= L: l2 norm of the error / norm of the function
  // without its mean; for c_00 relative to c_00. 1e-14 ... 1e-1. Rounding adds about 1e-15 c_00
  // times the largest r / d_T.
  double precision = 1e-8;
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<AnalyzeOptions>, const Visitor& field) {
  using O = AnalyzeOptions;
  field(&O::degree, {.name = "degree",
                     .help = "the highest degree; there are (L+1)^2 coefficients",
                     .value = "L",
                     .least = 0,
                     .most = kMaxDegree,
                     .in_python = false});
  field(&O::method,
        {.name = "method",
         .help = "which function is expanded (gauge: 1/r, the others r), and by which integrals"});
  field(&O::engine, {.name = "engine",
                     .help = "how sums are done: fast, on an oversampled grid, to the precision; "
                             "direct, term by term, slow; curl and area are always direct"});
  field(&O::precision, {.name = "precision",
                        .help = "wanted error of the coefficients, l2 relative to the norm of the "
                                "function without its mean, finer where a tolerance asks for it",
                        .value = "E",
                        .least = 1e-14,
                        .most = 0.1});
}

// Coefficients, and how they were found.
struct Analysis {
  Expansion expansion;         // with centre and method, norm and tail where they are known
  std::size_t edge_nodes = 0;  // quadrature nodes on edges
  std::size_t face_nodes = 0;  // and on faces
  // |sum_e s_e int_arc u ds| / sum_e |s_e| int_arc ds: zero for a closed, consistently
  // oriented mesh, whatever its shape; check of mesh and orientation, (M5). None with the fast
  // engine, which checks both by a hash over all half-edges.
  std::optional<double> closure_residual;
  std::optional<FastReport> fast;  // of the fast engine with the method edge
  // That the coefficients were wanted with: a search for a degree may have asked for more than
  // AnalyzeOptions::precision.
  double precision = 0;
  StageTimes times;  // "triangles", "spread", "fourier", "verify", "norms"
  // Truncation error over solid angle, sqrt(||f - f_L||^2 / 4 pi), in the unit of f, as the
  // difference of the exact norm and that of the coefficients, and how far it is at most from that
  // of exact coefficients: they are as exact as the precision. None if that is not below an eighth
  // of it (its square is known to a quarter), and if the surface is not star-shaped, for there (M7)
  // is not the norm.
  std::optional<double> truncation_rms, truncation_rms_doubt;
};

// Its list (fields.h), without the expansion.
template <typename Visitor>
void visit_fields(FieldsOf<Analysis>, const Visitor& field) {
  using A = Analysis;
  field(&A::edge_nodes, {.name = "edge_nodes", .help = "quadrature nodes on edges"});
  field(&A::face_nodes, {.name = "face_nodes", .help = "quadrature nodes on faces"});
  field(&A::closure_residual,
        {.name = "closure_residual",
         .help = "zero for a closed, consistently oriented mesh; None with the fast engine"});
  field(&A::fast, {.name = "fast", .help = "of the fast engine, or None"});
  field(&A::precision, {.name = "precision", .help = "that the coefficients were wanted with"});
  field(&A::times, {.name = "times", .help = "stages: (wall, cpu) in seconds"});
  field(&A::truncation_rms,
        {.name = "truncation_rms",
         .help = "truncation error over solid angle, in the unit of the function, or None"});
  field(&A::truncation_rms_doubt,
        {.name = "truncation_rms_doubt",
         .help = "how far it is at most from that of exact coefficients"});
}

// The coefficients of the surface by the method that is asked for. Throws InvalidInput for a degree
// or precision out of range, a centre on a vertex, or (gauge) a face seen edge on.
Analysis analyze(const StarChart& chart, const AnalyzeOptions& options = {},
                 const Context& context = {});

// int r^2 dOmega and int q^2 dOmega of a star-shaped surface in closed form, (M7).
double radius_norm_squared(const StarChart& chart);
double gauge_norm_squared(const StarChart& chart);
double radius_norm_squared(const MeshView& mesh, const Vec3& center, const Context& context = {});

// S = sum_e int_e (r^2 s_e)^2 ds for the radius, sum_e int_e s_e^2 ds for the gauge: the energy
// per degree is about S / (pi l^4) beyond the mesh's own resolution, method 5.
double tail_strength(const StarChart& chart, RadialFunction function);
// Of the radius, for a closed mesh where it lies: identical vertices count as one. 16 bytes of
// memory for each side of an edge whose other side is far away in the order of the triangles.
double tail_strength(const MeshView& mesh, const Vec3& center, const Context& context = {});

// The largest truncation errors at vertices, times 2 pi (L + 1): max over vertices of |sum of s_e
// over the edges that meet there|, times r^2 for the radius. Within 10 % of the largest error where
// L times the angle of the edges is above 10 (measured, L >= 64); on finer meshes too large.
// Between vertices that are saddles, edges may err more than they do: 2 |s_e| r^2 instead of the
// sum.
struct ErrorStrengths {
  double radius = 0;  // of the radius, in the mesh's unit
  double gauge = 0;   // of 1/r, in 1/unit
  // Of the distance between the surfaces: the radius's times cos gamma of the mean slope. Seen
  // obliquely a vertex is not rounded off evenly: 16 % too small for a box with cos gamma = 0.6.
  double distance = 0;
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<ErrorStrengths>, const Visitor& field) {
  using E = ErrorStrengths;
  field(&E::radius, {.name = "radius", .help = "of the radius, in the mesh's unit"});
  field(&E::gauge, {.name = "gauge", .help = "of 1/r, in 1/unit"});
  field(&E::distance, {.name = "distance", .help = "of the distance between the surfaces"});
}
// Of a closed mesh where it lies: identical vertices count as one. Throws InvalidInput as
// validate() does. 12 bytes of memory per vertex for places, 32 for sums.
ErrorStrengths vertex_error_strengths(const MeshView& mesh, const Vec3& center);
// That of the radius, or of the gauge, alone.
double vertex_error_strength(const StarChart& chart, RadialFunction function);

}  // namespace rholm
