// Geometric texture: the detail of a patch of one surface laid on a patch of another. Layer: edit.
//
// Each patch is a smooth base, what harmonics up to a degree of a cap over it can follow, and the
// detail on it, a height along the base's normal. Heights are carried from chart to chart (angle
// from the patch's axis and azimuth, as seen from the centre of its sphere), turned by the azimuth
// at which they are most like the target's own detail, scaled, faded in the target's transition.
// Heights of closed meshes are outwards, also of those that are inside out, which stay as they are.
// As with smoothing the analysis is separate from the update of the vertices.
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

// How detail is laid on the target.
enum class TransferMode : std::uint8_t {
  kDisplacement,  // along the target's base normals
  kCoefficients   // the coefficients above from_degree of one cap are put into the other's, raw:
                  // frame and size come along and the rim of the cap is a step. For comparison
};
EnumNames names_of(TransferMode mode);  // "displacement", "coefficients"

inline constexpr int kMaxTransferDegree = 64;  // from_degree of kDisplacement
inline constexpr int kMaxSwapDegree = 24;      // degree of a cap with kCoefficients

// What counts as detail, and how large it is laid.
struct TransferOptions {
  // The texture is what harmonics up to this degree on a cap over the source region leave:
  // wavelengths below 4 radii / from_degree. 2 ... kMaxTransferDegree.
  int from_degree = 8;
  // Lengths on the target by lengths on the source, in units of the regions' radii: 1 lays one
  // region on the other. > 0, at most 1e6.
  double scale = 1;
  // Splits the target's edges until they are as short as the source's are there. Coinciding
  // vertices become one, and new ones come after the old.
  bool refine = false;
  // Whether the angle at which the detail is most like the target's own is looked for, which is
  // half of the analysis. Without it the report's angle and correlation are 0.
  bool find_angle = true;
  // Of the target region; by default the wavelength of its base, at most a quarter of its radius.
  std::optional<double> transition = {};
};

// Their list (fields.h).
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

// What a slider moves.
struct TransferUpdate {
  double height = 1;  // of the texture, times what `scale` makes of it
  // Radians, counter-clockwise seen from outside; at 0 the texture lies as the shortest turn
  // between the patches' axes lays it. By default where it is most like the target's own detail, if
  // the analysis has looked for that, else 0.
  std::optional<double> angle = {};
  // Where the texture is smaller than the target region it is laid again, side by side, turned
  // alike, where neighbours agree best; they meet along the lines where they differ least.
  bool repeat = false;
  bool remove_own = false;  // the target's own detail of the same wavelengths goes first
  TransferMode mode = TransferMode::kDisplacement;  // kCoefficients is there to compare with
};

// Its list.
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

// What the analysis found. Lengths are in the units of the two meshes.
struct TransferReport {
  double source_radius = 0, target_radius = 0;  // of discs with the areas of the bases
  double scale = 1;                             // lengths on the target per length on the source
  double source_wavelength = 0, target_wavelength = 0;  // of the bases
  double source_edge = 0, target_edge = 0;  // median lengths, the target's after refinement
  double source_rms = 0;                    // height of the texture in its region
  double angle = 0;                         // of best correlation, radians
  double correlation = 0;                   // with the target's own detail there, -1 ... 1
  std::size_t new_vertices = 0;             // by refinement
};

// Its list.
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

// A texture taken from its source, to be laid on any number of targets.
struct TransferSource {
  int from_degree = 0;                               // of the options
  double radius = 0;                                 // of a disc with the area of the region
  double wavelength = 0, edge = 0, rms = 0;          // source_... of TransferReport
  std::shared_ptr<const TransferSourceState> state;  // the texture; shared by copies
};

// What an analysis knows.
struct TransferAnalysis {
  Mesh mesh;              // the target, refined if that was wanted
  Patch patch;            // the vertices that may move, and the base under them
  TransferReport report;  // in figures
  std::shared_ptr<const TransferState> state;  // what update() needs besides; shared by copies
};

// Covers both regions, takes the detail of one and looks at that of the other: the slow part.
// Throws InvalidInput for options out of range, for regions that one view cannot show (see the
// message), for bases finer than the mesh, and what region_weights() throws.
TransferAnalysis analyze_transfer(const Mesh& source, std::span<const Region> from,
                                  const Mesh& target, std::span<const Region> to,
                                  const TransferOptions& options = {}, const Context& context = {});

// The same in two: what is of the source, with from_degree as in the options, and what is of a
// target, which may be one that moves under a hand. The second also throws InvalidInput for a
// source without a texture, and for another from_degree than the source's.
TransferSource analyze_source(const Mesh& source, std::span<const Region> from,
                              int from_degree = TransferOptions{}.from_degree,
                              const Context& context = {});
TransferAnalysis analyze_transfer(const TransferSource& source, const Mesh& target,
                                  std::span<const Region> to, const TransferOptions& options = {},
                                  const Context& context = {});

// New positions of analysis.patch.vertices, for apply(). Throws InvalidInput for numbers that are
// not finite, and with kCoefficients for from_degree >= kMaxSwapDegree.
std::vector<Vec3> update(const TransferAnalysis& analysis, const TransferUpdate& wanted = {});

// Both, and apply(): the target with the texture on it.
Mesh transfer(const Mesh& source, std::span<const Region> from, const Mesh& target,
              std::span<const Region> to, const TransferOptions& options = {},
              const TransferUpdate& wanted = {}, const Context& context = {});

}  // namespace rholm
