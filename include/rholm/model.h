// From a mesh to a model, and the model file. Layer: model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rholm/analyze.h"
#include "rholm/coefficients.h"
#include "rholm/coefficients_io.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/star.h"
#include "rholm/topology.h"
#include "rholm/truncation.h"

namespace rholm {

// Degree or tolerance of a model, and the permitted changes to the mesh.
struct EncodeOptions {
  AnalyzeOptions analyze = {};  // degree, method, precision
  // If set, the smallest degree that keeps this tolerance replaces analyze.degree.
  std::optional<Tolerance> tolerance = {};
  bool errors = true;         // measure and predict Expansion::errors, for star-shaped surfaces
  ChartOptions chart = {};    // the centre, and whether other than star-shaped surfaces are allowed
  double weld_tolerance = 0;  // tolerance in the shape's unit; 0 merges bit-identical vertices
};

// Lists the fields of EncodeOptions (fields.h), with the lists of their parts.
template <typename Visitor>
void visit_fields(FieldsOf<EncodeOptions>, const Visitor& field) {
  using O = EncodeOptions;
  field(&O::analyze, {.name = "analyze",
                      .help = "degree, method, precision",
                      .in_program = false,
                      .in_python = false});
  field(&O::tolerance, {.name = "tolerance",
                        .help = "the smallest degree that keeps it, instead of a given one",
                        .in_program = false,
                        .in_python = false});
  field(&O::errors, {.name = "errors",
                     .help = "whether the errors of the surface are measured and predicted",
                     .in_program = false});
  field(&O::chart, {.name = "chart",
                    .help = "the centre, and whether others than star-shaped are taken",
                    .in_program = false,
                    .in_python = false});
  field(&O::weld_tolerance, {.name = "weld",
                             .help = "make vertices one whose distance is at most this, in the "
                                     "unit of the shape; 0 joins identical ones",
                             .value = "T",
                             .least = 0});
}

// Report on how a tolerance was kept: see ToleranceAnalysis.
struct ToleranceReport {
  double allowed = 0, reached = 0;  // wanted and final error, in the mesh's unit
  bool met = false;                 // true if reached <= allowed
  std::vector<int> degrees;  // tried degrees; the model has the last one, or is truncated from it
};

// Lists the fields of ToleranceReport.
template <typename Visitor>
void visit_fields(FieldsOf<ToleranceReport>, const Visitor& field) {
  using T = ToleranceReport;
  field(&T::allowed, {.name = "allowed", .help = "error, in the mesh's unit"});
  field(&T::reached, {.name = "reached", .help = "error, in the mesh's unit"});
  field(&T::met, {.name = "met", .help = "whether reached is at most allowed"});
  field(&T::degrees, {.name = "degrees",
                      .help = "that were tried; the model's is the last one, or cut off from it"});
}

// A mesh as coefficients, with a report.
struct Encoded {
  Analysis analysis;                         // analysis.expansion is the model
  std::optional<ToleranceReport> tolerance;  // if a tolerance was wanted
  StarReport star;                           // the centre, and how well the surface is seen from it
  double diagonal = 0;                       // diagonal of the bounding box
  std::size_t vertices = 0;                  // number after welding, if the mesh was welded
  std::size_t faces = 0, edges = 0;          // numbers after welding
  std::size_t merged_vertices = 0, collapsed_triangles = 0;  // results of welding, as in Welded
  bool flipped = false;                                      // true if the mesh was inside out
  // Stages "read", "topology", "center", "transform" and its parts; "rays" for a surface that is
  // not star-shaped.
  StageTimes times;
};

// Lists the fields of Encoded (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<Encoded>, const Visitor& field) {
  using E = Encoded;
  field(&E::analysis, {.name = "analysis", .help = "how the coefficients were found"});
  field(&E::tolerance, {.name = "tolerance", .help = "how the tolerance was kept, or None"});
  field(&E::star, {.name = "star", .help = "the centre, and how well it sees the surface"});
  field(&E::diagonal, {.name = "diagonal", .help = "of the bounding box"});
  field(&E::vertices, {.name = "vertices", .help = "after welding, where that was needed"});
  field(&E::faces, {.name = "faces", .help = "likewise"});
  field(&E::edges, {.name = "edges", .help = "likewise"});
  field(&E::merged_vertices, {.name = "merged_vertices", .help = "by welding"});
  field(&E::collapsed_triangles, {.name = "collapsed_triangles", .help = "by welding"});
  field(&E::flipped, {.name = "flipped", .help = "whether the mesh was inside out"});
  field(&E::times, {.name = "times", .help = "stages: (wall, cpu) in seconds"});
}

// Welds the mesh, turns it right side out, checks it, finds the centre, computes coefficients. A
// mesh that needs neither welding nor turning is not copied. Throws InvalidInput for options out of
// range, and the errors of its stages.
Encoded encode(const Mesh& mesh, const EncodeOptions& options = {}, const Context& context = {});
// Encodes arrays of another program; they are copied only if they must be changed.
Encoded encode(const MeshView& mesh, const EncodeOptions& options = {},
               const Context& context = {});
// Encodes a mesh in a mapped file, without a copy. Returns nothing if the file must be read.
// Causes: a mesh not closed, not oriented outwards, or not star-shaped (unless allowed with a given
// centre). Further causes: welding wanted, or not the method edge with the fast engine. Throws
// errors that do not concern the mesh (options, memory, Cancelled).
std::optional<Encoded> encode_mapped(const MappedMesh& mesh, const EncodeOptions& options = {},
                                     const Context& context = {});
// Encodes the mesh of a file. A large binary PLY file is mapped, not read (mapped_mesh.h), if its
// mesh needs no change: closed, oriented outwards, no welding wanted. If mapping fails, the file is
// read and not mapped again. Encoded::times also has "read". The reader's warnings are appended to
// `warnings`.
Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options = {},
                    const Context& context = {}, std::vector<std::string>* warnings = nullptr);
// Encodes a file in the same way; the function `read` reads the mesh if the file is not mapped.
Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
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
