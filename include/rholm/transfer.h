// Geometric texture: copies the detail of a patch of one surface to another patch. Layer: edit.
//
// Each patch has a smooth base, which harmonics up to a degree of a cap over it can follow. The
// detail is a height along the base's normal. Heights are carried from chart to chart (angle from
// the patch's axis and azimuth, seen from the centre of its sphere). They are turned to the azimuth
// at which they resemble the target's detail most, scaled, and faded in the target's transition.
// Heights of closed meshes point outwards, even if the mesh is inside out, which is not changed. As
// in smoothing, the analysis is separate from the update of the vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/region.h"
#include "rholm/smooth.h"

namespace rholm {

// Ways to add detail to the target.
enum class TransferMode : std::uint8_t {
  kDisplacement,  // along the normals of the target's base
  kCoefficients   // coefficients above from_degree of one cap replace the other cap's, including
                  // frame and size, with a step at the rim. For comparison
};
EnumNames names_of(TransferMode mode);  // "displacement", "coefficients"

inline constexpr int kMaxTransferDegree = 64;  // largest from_degree of kDisplacement
inline constexpr int kMaxSwapDegree = 24;      // largest degree of a cap with kCoefficients

// The detail to transfer, and its size.
struct TransferOptions {
  // The texture is the part of the source that harmonics up to this degree, on a cap over the
  // region, leave: wavelengths below 4 radii / from_degree. 2 ... kMaxTransferDegree.
  int from_degree = 8;
  // Lengths on the target divided by lengths on the source, in units of the regions' radii: 1 fills
  // the target region. > 0, at most 1e6.
  double scale = 1;
  // True: splits edges of the target until they are as short as edges of the source there.
  // Coinciding vertices are merged, and new vertices come after the old ones.
  bool refine = false;
  // True: the angle at which the detail resembles the target's own most is searched for, which is
  // half of the analysis. False: angle and correlation of the report are 0.
  bool find_angle = true;
  // Width at the target region; by default its base's wavelength, at most 1/4 of its radius.
  std::optional<double> transition = {};
};

// Lists the fields of TransferOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<TransferOptions>, const Visitor& field) {
  using O = TransferOptions;
  field(&O::from_degree,
        {.name = "from_degree",
         .help = "detail is what harmonics up to this degree over the source region leave: waves "
                 "shorter than 4 radii of the region by the degree",
         .value = "L0",
         .least = 2,
         .most = kMaxTransferDegree});
  field(
      &O::scale,
      {.name = "scale",
       .help =
           "size of the source region laid on the target, by that of the target region; 1 fills it",
       .value = "S",
       .least = 0,
       .most = 1e6,
       .above = true});
  field(&O::refine,
        {.name = "refine", .help = "split edges of the target where the detail is finer"});
  field(&O::find_angle, {.name = "find_angle",
                         .help = "look for the angle at which the detail is most like the target's "
                                 "own, which is half of the analysis",
                         .in_program = false,
                         .in_python = false});
  field(&O::transition,
        {.name = "transition",
         .help =
             "width over which the detail fades outside the region, in the unit of the target; by "
             "default the length of the waves of the base there, at most a quarter of its radius",
         .value = "T",
         .least = 0});
}

// Settings that update() applies quickly, for example while a slider moves.
struct TransferUpdate {
  double height = 1;  // factor of the heights, in addition to `scale`
  // Radians, counter-clockwise seen from outside. At 0 the texture is turned by the shortest
  // rotation between the patches' axes. By default the angle of the analysis, where the texture
  // resembles the target's detail most; 0 if not searched for.
  std::optional<double> angle = {};
  // True: a texture smaller than the target region is repeated side by side, all copies with the
  // same turn, where neighbours agree best. Copies meet along the lines of least difference.
  bool repeat = false;
  bool remove_own = false;  // removes the target's own detail of these wavelengths first
  TransferMode mode = TransferMode::kDisplacement;  // kCoefficients is for comparison
};

// Lists the fields of TransferUpdate.
template <typename Visitor>
void visit_fields(FieldsOf<TransferUpdate>, const Visitor& field) {
  using U = TransferUpdate;
  field(
      &U::height,
      {.name = "height", .help = "factor of the heights; -1 turns bumps into pits", .value = "H"});
  field(&U::angle, {.name = "angle",
                    .help = "turn of the detail, radians, counter-clockwise from outside; by "
                            "default where it is most like the target's own",
                    .value = "A",
                    .in_program = false});
  field(&U::repeat,
        {.name = "repeat", .help = "lay the detail again and again, for scales below 1"});
  field(&U::remove_own, {.name = "remove_own",
                         .help = "take the target's own detail of the same waves away first"});
  field(
      &U::mode,
      {.name = "mode",
       .help = "displacement: along the normals of the target's base; coefficients: the harmonics "
               "above the degree of one cap are put into the other, raw, for comparison"});
}

// Findings of the analysis. Lengths are in the units of the two meshes.
struct TransferReport {
  double source_radius = 0, target_radius = 0;  // radii of discs with the bases' areas
  double scale = 1;                             // length on the target per length on the source
  double source_wavelength = 0, target_wavelength = 0;  // wavelengths of the bases
  double source_edge = 0, target_edge = 0;  // median lengths, of the target after refinement
  double source_rms = 0;                    // rms height of the texture in its region
  double angle = 0;                         // angle of best correlation, radians
  double correlation = 0;                   // correlation with the target's detail there, -1 ... 1
  std::size_t new_vertices = 0;             // number, by refinement
};

// Lists the fields of TransferReport.
template <typename Visitor>
void visit_fields(FieldsOf<TransferReport>, const Visitor& field) {
  using R = TransferReport;
  field(&R::source_radius, {.name = "source_radius",
                            .help = "radius of a disc with the area of the source's base",
                            .unit = FieldUnit::kLength});
  field(&R::target_radius, {.name = "target_radius",
                            .help = "radius of a disc with the area of the target's base",
                            .unit = FieldUnit::kLength});
  field(&R::scale, {.name = "scale", .help = "lengths on the target per length on the source"});
  field(&R::source_wavelength,
        {.name = "source_wavelength", .help = "of the source's base", .unit = FieldUnit::kLength});
  field(&R::target_wavelength,
        {.name = "target_wavelength", .help = "of the target's base", .unit = FieldUnit::kLength});
  field(&R::source_edge, {.name = "source_edge",
                          .help = "median length of an edge of the source",
                          .unit = FieldUnit::kLength});
  field(&R::target_edge, {.name = "target_edge",
                          .help = "median length of an edge of the target, after refinement",
                          .unit = FieldUnit::kLength});
  field(&R::source_rms, {.name = "source_rms",
                         .help = "height of the texture in its region",
                         .unit = FieldUnit::kLength});
  field(&R::angle, {.name = "angle", .help = "turn of best correlation, radians"});
  field(&R::correlation,
        {.name = "correlation", .help = "with the target's own detail there, -1 ... 1"});
  field(&R::new_vertices, {.name = "new_vertices", .help = "vertices made by refinement"});
}

struct TransferSourceState;
struct TransferState;

// A texture extracted from its source, for any number of targets.
struct TransferSource {
  int from_degree = 0;                               // degree in the options
  double radius = 0;                                 // radius of a disc with the area of the region
  double wavelength = 0, edge = 0, rms = 0;          // source_... of TransferReport
  std::shared_ptr<const TransferSourceState> state;  // the texture; shared by copies
};

// Result of an analysis, for update().
struct TransferAnalysis {
  Mesh mesh;              // the target, refined if wanted
  Patch patch;            // the vertices that may move, and the base under them
  TransferReport report;  // radii, wavelengths, angle
  std::shared_ptr<const TransferState> state;  // further data for update(); shared by copies
};

// Covers both regions, extracts their detail and compares it: the slow part. Throws InvalidInput
// for options out of range, regions that one centre cannot see (see the message), bases finer than
// the mesh, and errors of region_weights().
TransferAnalysis analyze_transfer(const Mesh& source, std::span<const Region> from,
                                  const Mesh& target, std::span<const Region> to,
                                  const TransferOptions& options = {}, const Context& context = {});

// Splits analyze_transfer() into two steps: the source's analysis is reused for several targets,
// for example while the user drags the target region. Options must have the source's from_degree,
// otherwise InvalidInput is thrown, also for a source without a texture.
TransferSource analyze_source(const Mesh& source, std::span<const Region> from,
                              int from_degree = TransferOptions{}.from_degree,
                              const Context& context = {});
TransferAnalysis analyze_transfer(const TransferSource& source, const Mesh& target,
                                  std::span<const Region> to, const TransferOptions& options = {},
                                  const Context& context = {});

// Returns new positions of analysis.patch.vertices, for apply(). Throws InvalidInput for numbers
// that are not finite, and with kCoefficients for from_degree >= kMaxSwapDegree.
std::vector<Vec3> update(const TransferAnalysis& analysis, const TransferUpdate& wanted = {});

// Does analyze_transfer(), update() and apply(): returns the target with the texture.
Mesh transfer(const Mesh& source, std::span<const Region> from, const Mesh& target,
              std::span<const Region> to, const TransferOptions& options = {},
              const TransferUpdate& wanted = {}, const Context& context = {});

}  // namespace rholm
