// A surface as few large caps: a model smaller than its data (method 7.8). Layer: model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rholm/atlas.h"
#include "rholm/atlas_model.h"
#include "rholm/compare.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/simplify.h"

namespace rholm {

inline constexpr int kMaxCapDegree = 24;  // chosen: beyond, sums over scattered points are slow

// What a model is to keep, and how it is sought.
struct CompressOptions {
  double tolerance = 0;  // rms distance between the surfaces, both ways, in the shape's unit; > 0
  std::size_t samples = 0;  // that caps are fitted to; 0: by the tolerance
  int max_degree = 14;      // of a cap, 2 ... kMaxCapDegree
  std::uint64_t seed = 1;   // of samples and of the search
  // Numbers that the model may take (size_of()); 0: as many as the shape has coordinates, three per
  // vertex or point. A shape that would take more is refused.
  std::size_t max_numbers = 0;
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CompressOptions>, const Visitor& field) {
  using O = CompressOptions;
  field(&O::tolerance, {.name = "tolerance",
                        .help = "root mean square distance between the surfaces, both ways",
                        .value = "E",
                        .least = 0,
                        .above = true,
                        .unit = FieldUnit::kLength,
                        .in_program = false,
                        .in_python = false});
  field(&O::samples, {.name = "samples",
                      .help = "points that caps are fitted to; 0: by the tolerance",
                      .value = "N",
                      .least = 1000,
                      .most = kMaxSamples,
                      .may_be_zero = true,
                      .in_program = false});
  field(&O::max_degree, {.name = "max_degree",
                         .help = "highest degree of a cap",
                         .value = "L",
                         .least = 2,
                         .most = kMaxCapDegree});
  field(&O::seed, {.name = "seed", .help = "of samples and of the search", .value = "S"});
  field(&O::max_numbers, {.name = "max_numbers",
                          .help = "numbers that the model may take, coefficients and nine for each "
                                  "cap; 0: as many as the shape has coordinates",
                          .value = "N",
                          .least = 0});
}

// How large a model is: coefficients that are not zero, and the numbers of the caps' frames.
struct AtlasSize {
  std::size_t caps = 0, coefficients = 0, frame_numbers = 0;            // how many of each
  std::size_t numbers() const { return coefficients + frame_numbers; }  // of the whole model
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<AtlasSize>, const Visitor& field) {
  using S = AtlasSize;
  field(&S::caps, {.name = "caps", .help = "number of caps"});
  field(&S::coefficients, {.name = "coefficients", .help = "coefficients that are not zero"});
  field(&S::frame_numbers, {.name = "frame_numbers", .help = "numbers of the caps' frames"});
}

// Counts them.
AtlasSize size_of(const Atlas& atlas);

// How a model came about, and what it keeps.
struct CompressReport {
  std::size_t samples = 0;      // that caps were fitted to
  bool turned_normals = false;  // of points: all of them, they pointed into the solid
  double hidden = 0;  // share of a mesh that lies inside of its solid, where parts run into each
                      // other: left out, and not measured
  double gap = 0;     // between sheets that face each other: less on a twentieth of the area
  double aimed = 0;   // the tolerance that was aimed at: thin shapes need a smaller one than asked
  double uncovered = 0;                   // share of the samples that no cap met by 4 tolerances
  std::size_t components = 0, genus = 0;  // of the extracted surface
  bool met = false;                       // the tolerance
  // The surface has as many parts and handles as the shape, if that is a closed manifold and no
  // part of it is hidden; true for others.
  bool topology_kept = false;
  StageTimes times = {};  // "samples", "caps", "fit", "surface"
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<CompressReport>, const Visitor& field) {
  using R = CompressReport;
  field(&R::samples, {.name = "samples", .help = "points that caps were fitted to"});
  field(&R::turned_normals,
        {.name = "turned_normals",
         .help = "whether all normals of points pointed into the solid, and were turned"});
  field(&R::hidden, {.name = "hidden",
                     .help = "share of a mesh that lies inside of its solid, and was left out"});
  field(&R::gap, {.name = "gap",
                  .help = "distance between sheets that face each other",
                  .unit = FieldUnit::kLength});
  field(&R::aimed,
        {.name = "aimed", .help = "tolerance that was aimed at", .unit = FieldUnit::kLength});
  field(&R::uncovered,
        {.name = "uncovered", .help = "share of the samples that no cap met by 4 tolerances"});
  field(&R::components, {.name = "components", .help = "parts of the extracted surface"});
  field(&R::genus, {.name = "genus", .help = "handles of the extracted surface"});
  field(&R::met, {.name = "met", .help = "whether the tolerance is kept"});
  field(&R::topology_kept,
        {.name = "topology_kept",
         .help = "whether the surface has as many parts and handles as the shape"});
  field(&R::times, {.name = "times", .help = "seconds of each stage"});
}

// A shape as few caps.
struct Compressed {
  AtlasModel model;       // with the errors of its surface
  CompressReport report;  // how it was found
};

// Covers the shape with few caps, fits them, drops the coefficients its error can do without,
// extracts the surface and measures it, until it is within the tolerance both ways and hangs
// together as the shape does. A mesh may be open, and is first made outward(); of one whose parts
// run into each other the outer surface is taken; points need normals (if they point into a solid
// that the points lie all around, they are turned) and are taken as evenly spread (measured from
// the points only). Throws InvalidInput for shapes without area, triangles that are not oriented
// alike, and options out of range; Unsupported for shapes too thin for the grid, and where the caps
// would take more numbers than `max_numbers`. The tolerance may be missed, see `met`, and so may
// parts and handles, see `topology_kept`. Same input, same bits for any number of threads.
Compressed compress(const Mesh& mesh, const CompressOptions& options, const Context& context = {});
Compressed compress(const PointCloud& cloud, const CompressOptions& options,
                    const Context& context = {});

// How a surface is extracted from a model.
struct AtlasSynthesisOptions {
  double step = 0;  // edge of the grid's cubes; 0: the model's, and see `simplify`
  // The caps have no higher degrees, and are fitted to the model's own surface with those they
  // have.
  std::optional<int> degree = {};
  // Fewer triangles for the same surface; none: as the model's rules say. A level, of a degree
  // below the highest, whose step and `simplify` are not given, is simplified to a tenth of the
  // error that its degree makes.
  std::optional<SimplifyOptions> simplify = {};
  std::size_t max_memory = std::size_t{8} << 30;  // bytes: refused if more is foreseen
};

// Their list.
template <typename Visitor>
void visit_fields(FieldsOf<AtlasSynthesisOptions>, const Visitor& field) {
  using O = AtlasSynthesisOptions;
  field(&O::step, {.name = "step",
                   .help = "edge of the grid's cubes; 0: the model's",
                   .value = "H",
                   .least = 0,
                   .unit = FieldUnit::kLength,
                   .in_program = false});
  field(&O::degree, {.name = "degree",
                     .help = "caps have no higher degrees",
                     .value = "L",
                     .least = 0,
                     .in_program = false});
  field(&O::simplify, {.name = "simplify",
                       .help = "fewer triangles for the same surface: to 1/50 of a step, so many, "
                               "or as options say; by default as a reconstruction was simplified",
                       .in_program = false});
  field(&O::max_memory, {.name = "max_memory",
                         .help = "refused if more memory is foreseen",
                         .value = "BYTES",
                         .unit = FieldUnit::kBytes,
                         .changes_result = false,
                         .in_program = false});
}

// The surface of a model, from it alone: closed, oriented outwards, with normals nx, ny, nz. Of a
// reconstruction it is the surface that reconstruct() made, to the bit where `step` and `degree`
// are not given: open where that is open, and simplified as that is, unless `simplify` is given.
// Throws InvalidInput for a step so large that no surface is left, OutOfMemory for one too small,
// and Unsupported for a degree so low that caps stand beside each other as plates, with the least
// that will do.
Mesh synthesize(const AtlasModel& model, const AtlasSynthesisOptions& options = {},
                const Context& context = {});

inline constexpr std::uint32_t kNoCap = ~std::uint32_t{0};  // where a cap's number is wanted
// The cap of the largest blend weight at each point, in small gaps between caps the nearest one;
// kNoCap for an atlas without caps.
std::vector<std::uint32_t> dominant_caps(const Atlas& atlas, const std::vector<Vec3>& points,
                                         const Context& context = {});
// Sets red, green, blue: a colour per cap, caps that touch of different hues; grey without a cap.
void set_cap_colors(std::vector<Attribute>& attributes, const Atlas& atlas,
                    const std::vector<std::uint32_t>& caps);
// The same by the degrees of the caps: dark blue for the lowest of the atlas to yellow for the
// highest.
void set_degree_colors(std::vector<Attribute>& attributes, const Atlas& atlas,
                       const std::vector<std::uint32_t>& caps);

}  // namespace rholm
