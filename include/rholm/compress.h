// A surface as a small number of large caps, smaller than its data (method 7.8). Layer: model.
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

// Tolerance and limits of compress().
struct CompressOptions {
  double tolerance = 0;     // rms distance between the surfaces, both directions, shape's unit; > 0
  std::size_t samples = 0;  // number of samples for fitting caps; 0: chosen by the tolerance
  int max_degree = 14;      // highest degree of a cap, 2 ... kMaxCapDegree
  std::uint64_t seed = 1;   // seed of samples and of the search
  // Largest number of values in the model (size_of()). 0: the number of coordinates of the shape,
  // three per vertex or point. A shape that needs more is refused.
  std::size_t max_numbers = 0;
};

// Lists the fields of CompressOptions (fields.h).
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

// Size of a model: nonzero coefficients, and the numbers of the caps' frames.
struct AtlasSize {
  std::size_t caps = 0, coefficients = 0, frame_numbers = 0;            // counts
  std::size_t numbers() const { return coefficients + frame_numbers; }  // size of the whole model
};

// Lists the fields of AtlasSize.
template <typename Visitor>
void visit_fields(FieldsOf<AtlasSize>, const Visitor& field) {
  using S = AtlasSize;
  field(&S::caps, {.name = "caps", .help = "number of caps"});
  field(&S::coefficients, {.name = "coefficients", .help = "coefficients that are not zero"});
  field(&S::frame_numbers, {.name = "frame_numbers", .help = "numbers of the caps' frames"});
}

// Counts caps, nonzero coefficients and frame numbers of an atlas.
AtlasSize size_of(const Atlas& atlas);

// Report of compress(): how the model was computed, and how well it keeps the shape.
struct CompressReport {
  std::size_t samples = 0;      // number of samples that caps were fitted to
  bool turned_normals = false;  // true if the points' normals all pointed inwards and were turned
  double hidden = 0;  // share of a mesh inside of its own solid, where parts intersect; left out,
                      // and not measured
  double gap = 0;     // between facing sheets; smaller on a twentieth of the area
  double aimed = 0;   // tolerance used; for thin shapes smaller than the wanted one
  double uncovered = 0;                   // share of samples beyond 4 tolerances of each cap
  std::size_t components = 0, genus = 0;  // numbers of the extracted surface
  bool met = false;                       // true if the tolerance is met
  // True if the surface has as many parts and handles as the shape. Compared only for a closed
  // manifold without hidden parts; true for other shapes.
  bool topology_kept = false;
  StageTimes times = {};  // stages "samples", "caps", "fit", "surface"
};

// Lists the fields of CompressReport.
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

// A compressed shape, and its report.
struct Compressed {
  AtlasModel model;       // model with the errors of its surface
  CompressReport report;  // statistics of the computation
};

// Computes a model of a small number of caps. It covers the shape with caps, fits them, drops
// coefficients that the error does not need, extracts the surface and measures it. This is repeated
// until the surface is within the tolerance in both directions and connected like the shape. A mesh
// may be open; outward() is applied first. If parts of a mesh intersect, the outer surface is used.
// Points need normals and count as evenly spread; errors are measured from the points only. If
// normals point into a solid that the points surround, they are turned. Throws InvalidInput for no
// area, inconsistent orientation, options out of range; Unsupported for shapes too thin for the
// grid and caps above `max_numbers`. See `met` and `topology_kept`: both may fail. Same input, same
// bits for any number of threads.
Compressed compress(const Mesh& mesh, const CompressOptions& options, const Context& context = {});
Compressed compress(const PointCloud& cloud, const CompressOptions& options,
                    const Context& context = {});

// Options for extracting the surface from a model.
struct AtlasSynthesisOptions {
  double step = 0;  // edge of the grid's cubes; 0: the model's step (see also `simplify`)
  // Highest degree of the caps. Caps of higher degrees are fitted again, with this degree, to the
  // model's own surface.
  std::optional<int> degree = {};
  // Reduces the number of triangles; empty: as the model's rules
  // say. A surface of a lower degree is simplified to a tenth of the
  // error of that degree if neither `step` nor `simplify` is given.
  std::optional<SimplifyOptions> simplify = {};
  std::size_t max_memory = std::size_t{8} << 30;  // bytes; throws if the estimate is above
};

// Lists the fields of AtlasSynthesisOptions (fields.h).
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

// Extracts the surface from a model: closed, oriented outwards, with normals nx, ny, nz. A
// reconstruction gives the surface of reconstruct(), also if that is open or simplified. It
// is the same to the bit if `step`, `degree` and `simplify` are not given. Throws
// InvalidInput for a step so large that no surface is left, OutOfMemory for a step too small.
// Throws Unsupported, with the least sufficient degree, for a degree at which caps no longer
// join.
Mesh synthesize(const AtlasModel& model, const AtlasSynthesisOptions& options = {},
                const Context& context = {});

inline constexpr std::uint32_t kNoCap = ~std::uint32_t{0};  // stands for no cap in dominant_caps()
// Returns for each point the cap of largest blend weight, in small gaps between caps the nearest
// cap. Returns kNoCap for an atlas without caps.
std::vector<std::uint32_t> dominant_caps(const Atlas& atlas, const std::vector<Vec3>& points,
                                         const Context& context = {});
// Sets red, green, blue by cap: touching caps differ in hue; points without a cap are grey.
void set_cap_colors(std::vector<Attribute>& attributes, const Atlas& atlas,
                    const std::vector<std::uint32_t>& caps);
// Sets red, green, blue by the degree of the cap: dark blue for the lowest degree of the atlas to
// yellow for the highest.
void set_degree_colors(std::vector<Attribute>& attributes, const Atlas& atlas,
                       const std::vector<std::uint32_t>& caps);

}  // namespace rholm
