// Local smoothing: detail finer than a wavelength is taken from a region of a mesh. Layer: edit.
//
// Overlapping caps of a few wavelengths cover the region and its transition. In each the surface
// is a function on an opened sphere and is fitted by harmonics up to a degree whose waves have that
// length on the surface; the fits are blended. Vertices move along the rays of the caps, by their
// weight in the region. Any genus, closed or open; connectivity stays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/region.h"

namespace rholm {

// What the smooth surface is fitted to.
enum class PatchFitting : std::uint8_t {
  kMean,    // all points, by least squares: averages over what is finer than the wavelength
  kRobust,  // all but what stands out, narrower than half the wavelength: scratches, spikes
  kAround   // what is not in the region, robustly: the region is bridged, with the detail of its
            // rim carried in; it may be half a wavelength wide, and nothing else moves
};
EnumNames names_of(PatchFitting fitting);  // "mean", "robust", "around"

// What is to go from a region.
struct PatchOptions {
  // The finest detail that may stay: waves of this length keep their height, of 0.8 of it half,
  // of 0.6 nothing (docs/editing.md has the curve). In the unit of the vertices, > 0.
  double wavelength = 0;
  // Width of the region's transition; by default the wavelength. kAround needs none.
  std::optional<double> transition = {};
  PatchFitting fitting = PatchFitting::kRobust;  // of the caps
  // Moves only what stands out from a robust fit, and fades a quarter of a wavelength beyond:
  // scratches go, the texture around them stays.
  bool repair = false;
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<PatchOptions>, const Visitor& field) {
  using O = PatchOptions;
  field(&O::wavelength, {.name = "wavelength",
                         .help = "detail finer than this goes, in the unit of the shape",
                         .value = "W",
                         .least = 0,
                         .above = true,
                         .in_python = false});
  field(&O::transition, {.name = "transition",
                         .help = "width over which the edit fades outside the region, in the unit "
                                 "of the shape; by default the wavelength",
                         .value = "T",
                         .least = 0});
  field(&O::fitting,
        {.name = "fitting",
         .help = "what the smooth surface is fitted to; robust: all but what stands out; mean: "
                 "all; around: what is outside the region, which is bridged"});
  field(&O::repair, {.name = "repair",
                     .help = "move only what stands out, scratches and spikes; texture stays"});
}

// What an analysis knows: the vertices that may move, and where fits of each degree want them.
struct Patch {
  double wavelength = 0;                // of the analysis, in the unit of the vertices
  int degree = 0;                       // of the fits for that wavelength
  std::vector<std::uint32_t> vertices;  // those that may move
  std::vector<Vec3> positions;          // as they are
  std::vector<double> weights;          // in the region, above 0
  // From there to the fit of degree d at [i (degree + 1) + d].
  std::vector<Vec3> moves;
  std::size_t caps = 0;       // that cover the region
  std::size_t unreached = 0;  // vertices that no cap sees: they stay
};

// Covers the region with caps and fits them: the slow part. Throws InvalidInput for a wavelength
// that is not positive or not above the mesh's spacing there, for a region that is too wide to be
// bridged, and what region_weights() throws.
Patch analyze_patch(const Mesh& mesh, std::span<const Region> regions, const PatchOptions& options,
                    const Context& context = {});

// What a slider moves.
struct PatchUpdate {
  double wavelength = 0;  // by default the analysis'; longer ones up to longest_wavelength()
  double strength = 1;    // 0 leaves all as it is, 1 takes the detail away, -1 doubles it
};

// Its list (fields.h). The bounds of the strength are chosen: the program takes no others.
template <typename Visitor>
void visit_fields(FieldsOf<PatchUpdate>, const Visitor& field) {
  using U = PatchUpdate;
  field(&U::wavelength, {.name = "wavelength",
                         .help = "detail finer than this goes; 0: that of the analysis",
                         .value = "W",
                         .least = 0,
                         .in_program = false,
                         .in_python = false});
  field(&U::strength, {.name = "strength",
                       .help = "1 takes the detail away, 0.5 half of it, -1 doubles it",
                       .value = "S",
                       .least = -10,
                       .most = 1});
}

// That of the lowest degree that is fitted.
double longest_wavelength(const Patch& patch);

// New positions of patch.vertices. Throws InvalidInput for a wavelength the patch was not analysed
// for, or a strength that is not finite.
std::vector<Vec3> update(const Patch& patch, const PatchUpdate& wanted = {});

// Puts the patch's vertices there; normals among the mesh's attributes (nx, ny, nz) follow.
void apply(const Patch& patch, std::span<const Vec3> positions, Mesh& mesh);

}  // namespace rholm
