// From a mesh to a model, and the model file. Layer: model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/coefficients_io.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/star.h"
#include "rholm/topology.h"
#include "rholm/transform.h"
#include "rholm/truncation.h"

namespace rholm {

// Degree or tolerance of a model, and the permitted changes to the mesh.
struct ExpandOptions {
  int degree = TransformOptions{}.degree;           // as in TransformOptions
  Method method = TransformOptions{}.method;        // as in TransformOptions
  Engine engine = TransformOptions{}.engine;        // as in TransformOptions
  double precision = TransformOptions{}.precision;  // as in TransformOptions
  // If set, the smallest degree that keeps this tolerance replaces `degree`.
  std::optional<Tolerance> tolerance = {};
  bool errors = true;         // measure and predict Expansion::errors, for star-shaped surfaces
  ChartOptions chart = {};    // the centre, and whether other than star-shaped surfaces are allowed
  double weld_tolerance = 0;  // tolerance in the shape's unit; 0 merges bit-identical vertices
};

// Lists the fields of ExpandOptions (fields.h), with the lists of their parts.
template <typename Visitor>
void visit_fields(FieldsOf<ExpandOptions>, const Visitor& field) {
  using O = ExpandOptions;
  visit_transform_fields<O>(field);
  field(&O::tolerance, {.name = "tolerance",
                        .help = "tolerance of the model, which then has the smallest degree that "
                                "meets it, instead of a given degree",
                        .in_program = false,
                        .in_python = false});
  field(&O::errors, {.name = "errors",
                     .help = "measure and predict the errors of the surface",
                     .in_program = false});
  field(&O::chart, {.name = "chart",
                    .help = "options of the centre and of surfaces that are not star-shaped",
                    .in_program = false,
                    .in_python = false});
  field(&O::weld_tolerance, {.name = "weld",
                             .help = "merge vertices within this distance of each other, in the "
                                     "unit of the shape; 0: identical vertices only",
                             .value = "T",
                             .least = 0});
}

// Returns the options of the transform alone.
inline TransformOptions transform_options(const ExpandOptions& options) {
  return {.degree = options.degree,
          .method = options.method,
          .engine = options.engine,
          .precision = options.precision};
}

// Report on how a tolerance was kept: see ToleranceTransform.
struct ToleranceReport {
  double allowed = 0, reached = 0;  // wanted and final error, in the mesh's unit
  bool met = false;                 // true if reached <= allowed
  std::vector<int> degrees;  // tried degrees; the model has the last one, or is truncated from it
};

// Lists the fields of ToleranceReport.
template <typename Visitor>
void visit_fields(FieldsOf<ToleranceReport>, const Visitor& field) {
  using T = ToleranceReport;
  field(&T::allowed, {.name = "allowed", .help = "largest allowed error, in the unit of the mesh"});
  field(&T::reached, {.name = "reached", .help = "error of the model, in the unit of the mesh"});
  field(&T::met,
        {.name = "met", .help = "true if the error of the model is at most the allowed error"});
  field(&T::degrees,
        {.name = "degrees",
         .help = "degrees that were tried; the model has the last degree or is truncated from it"});
}

// A mesh as coefficients, with a report.
struct Expanded {
  Transform transform;                       // transform.expansion is the model
  std::optional<ToleranceReport> tolerance;  // if a tolerance was wanted
  StarReport star;                           // the centre, and how well the surface is seen from it
  double diagonal = 0;                       // diagonal of the bounding box
  std::size_t vertices = 0;                  // number after welding, if the mesh was welded
  std::size_t faces = 0, edges = 0;          // numbers after welding
  std::size_t merged_vertices = 0, collapsed_faces = 0;  // results of welding, as in Welded
  bool flipped = false;                                  // true if the mesh was inside out
  // Stages "read", "topology", "center", "transform" and its parts; "rays" for a surface that is
  // not star-shaped.
  StageTimes times;
};

// Lists the fields of Expanded (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<Expanded>, const Visitor& field) {
  using E = Expanded;
  field(&E::transform,
        {.name = "transform", .help = "report of the transform that computed the coefficients"});
  field(&E::tolerance, {.name = "tolerance",
                        .help = "report on the wanted tolerance, or None without a tolerance"});
  field(&E::star,
        {.name = "star", .help = "centre, and visibility of the surface from the centre"});
  field(&E::diagonal, {.name = "diagonal", .help = "diagonal of the bounding box of the mesh"});
  field(&E::vertices,
        {.name = "vertices", .help = "number of vertices, after welding if the mesh was welded"});
  field(&E::faces,
        {.name = "faces", .help = "number of faces, after welding if the mesh was welded"});
  field(&E::edges,
        {.name = "edges", .help = "number of edges, after welding if the mesh was welded"});
  field(&E::merged_vertices,
        {.name = "merged_vertices", .help = "number of vertices removed by welding"});
  field(&E::collapsed_faces,
        {.name = "collapsed_faces",
         .help = "number of faces removed because welding merged two of their corners"});
  field(&E::flipped, {.name = "flipped", .help = "true if the mesh was inside out and was turned"});
  field(&E::times,
        {.name = "times", .help = "wall and CPU time of each stage, in seconds: (wall, cpu)"});
}

// Welds the mesh, turns it right side out, checks it, finds the centre, computes coefficients. A
// mesh that needs neither welding nor turning is not copied. Throws InvalidInput for options out of
// range, and the errors of its stages.
Expanded expand(const Mesh& mesh, const ExpandOptions& options = {}, const Context& context = {});
// Expands arrays of another program; they are copied only if they must be changed.
Expanded expand(const MeshView& mesh, const ExpandOptions& options = {},
                const Context& context = {});
// Expands a mesh in a mapped file, without a copy. Returns nothing if the file must be read.
// Causes: a mesh not closed, not oriented outwards, or not star-shaped (unless allowed with a given
// centre). Further causes: welding wanted, or not the method edge with the fast engine. Throws
// errors that do not concern the mesh (options, memory, Cancelled).
std::optional<Expanded> expand_mapped(const MappedMesh& mesh, const ExpandOptions& options = {},
                                      const Context& context = {});
// Expands the mesh of a file. A large binary PLY file is mapped, not read (mapped_mesh.h), if its
// mesh needs no change: closed, oriented outwards, no welding wanted. If mapping fails, the file is
// read and not mapped again. Expanded::times also has "read". The reader's warnings are appended to
// `warnings`.
Expanded expand_file(const std::filesystem::path& path, const ExpandOptions& options = {},
                     const Context& context = {}, std::vector<std::string>* warnings = nullptr);
// Expands a file in the same way; the function `read` reads the mesh if the file is not mapped.
Expanded expand_file(const std::filesystem::path& path, const ExpandOptions& options,
                     const Context& context, const std::function<Mesh()>& read);

// Write and read the model file: HDF5, layout in docs/model-file.md. Writing goes to a temporary
// file that replaces `path` when complete. "-" can be read but not written (HDF5 seeks). Throw Io,
// InvalidInput, Unsupported (a newer major version).
void write_model(const Expansion& expansion, const std::filesystem::path& path);
Expansion read_model(const std::filesystem::path& path);

// Reads any file of coefficients: a model file, or a file for read_coefficients().
CoefficientsFile read_any_coefficients(const std::filesystem::path& path,
                                       const CoefficientsReadOptions& options = {},
                                       const Context& context = {});

}  // namespace rholm
