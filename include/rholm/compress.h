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
  field(&O::tolerance,
        {.name = "tolerance",
         .help = "largest root mean square distance between the surfaces, in both directions",
         .value = "E",
         .least = 0,
         .above = true,
         .unit = FieldUnit::kLength,
         .in_program = false,
         .in_python = false});
  field(&O::samples,
        {.name = "samples",
         .help = "number of points that caps are fitted to; 0: chosen from the tolerance",
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
  field(&O::seed, {.name = "seed",
                   .help = "seed of the random samples and of the search for caps",
                   .value = "S"});
  field(&O::max_numbers, {.name = "max_numbers",
                          .help = "largest number of values in the model, coefficients and nine "
                                  "per cap; 0: the number of coordinates of the shape",
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
  field(&S::coefficients,
        {.name = "coefficients", .help = "number of coefficients that are not zero"});
  field(&S::frame_numbers,
        {.name = "frame_numbers", .help = "number of values that describe the frames of all caps"});
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
  field(&R::samples, {.name = "samples", .help = "number of points that caps were fitted to"});
  field(&R::turned_normals,
        {.name = "turned_normals",
         .help = "true if all normals of the points pointed into the solid and were turned"});
  field(&R::hidden, {.name = "hidden",
                     .help = "share of a mesh that lies inside its own solid and was left out"});
  field(
      &R::gap,
      {.name = "gap",
       .help =
           "distance between sheets that face each other; it is smaller on a twentieth of the area",
       .unit = FieldUnit::kLength});
  field(&R::aimed,
        {.name = "aimed",
         .help = "tolerance that was used; for thin shapes it is smaller than the wanted one",
         .unit = FieldUnit::kLength});
  field(&R::uncovered, {.name = "uncovered",
                        .help = "share of the samples farther than 4 tolerances from every cap"});
  field(&R::components,
        {.name = "components", .help = "number of connected parts of the extracted surface"});
  field(&R::genus, {.name = "genus", .help = "number of handles of the extracted surface"});
  field(&R::met, {.name = "met", .help = "true if the tolerance is met"});
  field(&R::topology_kept, {.name = "topology_kept",
                            .help = "true if the surface has as many parts and handles as the "
                                    "shape, or if they are not compared"});
  field(&R::times,
        {.name = "times", .help = "wall and CPU time of each stage, in seconds: (wall, cpu)"});
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
                   .help = "edge length of the grid's cubes; 0: the step of the model",
                   .value = "H",
                   .least = 0,
                   .unit = FieldUnit::kLength,
                   .in_program = false});
  field(&O::degree,
        {.name = "degree",
         .help =
             "highest degree of the caps; caps of higher degrees are fitted again with this degree",
         .value = "L",
         .least = 0,
         .in_program = false});
  field(&O::simplify, {.name = "simplify",
                       .help = "reduce the faces: True for an error of 1/50 of a step, a number of "
                               "faces, or options of simplify; by default as the model says",
                       .in_program = false});
  field(&O::max_memory,
        {.name = "max_memory",
         .help = "largest estimated memory; the surface is refused if it needs more",
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
