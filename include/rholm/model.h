// The whole way from a mesh to a model, and the model file. Layer: model.
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

// What is wanted of a model, and what may be done to the mesh.
struct EncodeOptions {
  AnalyzeOptions analyze = {};  // degree, method, precision
  // The smallest degree that keeps it, instead of analyze.degree.
  std::optional<Tolerance> tolerance = {};
  bool errors = true;       // measure and predict them: Expansion::errors of a star-shaped surface
  ChartOptions chart = {};  // the centre, and whether others than star-shaped are taken
  double weld_tolerance = 0;  // in the shape's unit; 0 welds bit-identical vertices
};

// Their list (fields.h), with the lists of their parts.
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

// How a tolerance was kept: see ToleranceAnalysis.
struct ToleranceReport {
  double allowed = 0, reached = 0;  // errors, in the mesh's unit
  bool met = false;                 // the tolerance
  std::vector<int> degrees;  // that were tried; the model's is the last one, or cut off from it
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<ToleranceReport>, const Visitor& field) {
  using T = ToleranceReport;
  field(&T::allowed, {.name = "allowed", .help = "error, in the mesh's unit"});
  field(&T::reached, {.name = "reached", .help = "error, in the mesh's unit"});
  field(&T::met, {.name = "met", .help = "whether reached is at most allowed"});
  field(&T::degrees, {.name = "degrees",
                      .help = "that were tried; the model's is the last one, or cut off from it"});
}

// A mesh as coefficients, and what was found out on the way.
struct Encoded {
  Analysis analysis;                         // analysis.expansion is the model
  std::optional<ToleranceReport> tolerance;  // if one was asked for
  StarReport star;                           // the centre, and how well it sees the surface
  double diagonal = 0;                       // of the bounding box
  std::size_t vertices = 0;                  // after welding, where that was needed
  std::size_t faces = 0, edges = 0;          // likewise
  std::size_t merged_vertices = 0, collapsed_triangles = 0;  // by welding, as in Welded
  bool flipped = false;                                      // the mesh was inside out
  // "read", "topology", "center", "transform" and its parts, "rays" of a surface that is not
  // star-shaped.
  StageTimes times;
};

// Its list (fields.h).
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

// Welds, turns right side out, checks, finds the centre, transforms: a mesh that needs neither of
// the first is worked through where it lies. Throws InvalidInput for options out of range, and what
// its stages throw.
Encoded encode(const Mesh& mesh, const EncodeOptions& options = {}, const Context& context = {});
// The same for arrays of another program: copied only if it must be changed first.
Encoded encode(const MeshView& mesh, const EncodeOptions& options = {},
               const Context& context = {});
// The same for a mesh in a mapped file, worked through where it lies; none if it must be read
// and changed first: not closed and oriented outwards as it is, not star-shaped (unless that is
// allowed and the centre given), other methods than edge by the fast engine, or welding asked for.
// What is no fault of the mesh (options, memory, Cancelled) is thrown.
std::optional<Encoded> encode_mapped(const MappedMesh& mesh, const EncodeOptions& options = {},
                                     const Context& context = {});
// The same for a file. A large binary PLY file is mapped, not read, and worked through where it
// lies (see mapped_mesh.h), if nothing has to be changed: its triangles closed and oriented
// outwards, no welding asked for. What cannot be taken as it lies is not tried so again once it is
// read. Encoded::times has "read", too. `warnings` of the reader are appended.
Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options = {},
                    const Context& context = {}, std::vector<std::string>* warnings = nullptr);
// The same where the caller reads what cannot stay in the file.
Encoded encode_file(const std::filesystem::path& path, const EncodeOptions& options,
                    const Context& context, const std::function<Mesh()>& read);

// The model file: HDF5, layout in docs/model-file.md. Written to a temporary file that replaces
// `path` when complete; "-" can be read but not written (HDF5 seeks). Throws Io, InvalidInput,
// Unsupported (a newer major version).
void write_model(const Expansion& expansion, const std::filesystem::path& path);
Expansion read_model(const std::filesystem::path& path);

// Any file of coefficients: a model file, or what read_coefficients() reads.
CoefficientsFile read_any_coefficients(const std::filesystem::path& path,
                                       const CoefficientsReadOptions& options = {},
                                       const Context& context = {});

}  // namespace rholm
