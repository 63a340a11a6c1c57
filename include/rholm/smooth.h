// Local smoothing: removes detail finer than a wavelength from a region. Layer: edit.
//
// Overlapping caps of some wavelengths in size cover the region and its transition. In each cap the
// surface is a function on an opened sphere. It is fitted by harmonics up to the degree whose waves
// have the wanted length on the surface; the fits are blended. Vertices move along the rays of the
// caps, by their weight in the region. Any genus, closed or open; connectivity stays.
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

// Points that the smooth surface is fitted to.
enum class PatchFitting : std::uint8_t {
  kMean,    // all points, by least squares: averages over detail finer than the wavelength
  kRobust,  // robust: ignores outliers narrower than half the wavelength, scratches, spikes
  kAround   // points outside the region, robust: bridges a region up to half a wavelength wide,
            // with the detail of its rim; nothing else moves
};
EnumNames names_of(PatchFitting fitting);  // "mean", "robust", "around"

// Wavelength and method of the smoothing.
struct PatchOptions {
  // Finest detail to keep: waves of this length keep their height, 0.8 of this length half of it,
  // 0.6 none (curve in docs/editing.md). In the unit of the vertices, > 0.
  double wavelength = 0;
  // Width of the region's transition; by default the wavelength. kAround needs no transition.
  std::optional<double> transition = {};
  PatchFitting fitting = PatchFitting::kRobust;  // fitting of the caps
  // True: moves only outliers of a robust fit, and fades within a quarter of a wavelength around
  // them. Scratches are removed, the texture around them stays.
  bool repair = false;
};

// Lists the fields of PatchOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<PatchOptions>, const Visitor& field) {
  using O = PatchOptions;
  field(&O::wavelength,
        {.name = "wavelength",
         .help = "wavelength below which detail is removed, in the unit of the shape",
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
         .help = "points that the smooth surface is fitted to; robust: all except outliers; mean: "
                 "all; around: points outside the region, to bridge it"});
  field(&O::repair, {.name = "repair",
                     .help = "move only outliers such as scratches and spikes; the texture stays"});
}

// Result of an analysis: the vertices that may move, and their moves for fits of each degree.
struct Patch {
  double wavelength = 0;                // wavelength of the analysis, in the unit of the vertices
  int degree = 0;                       // degree of the fits for that wavelength
  std::vector<std::uint32_t> vertices;  // indices of the vertices that may move
  std::vector<Vec3> positions;          // their given positions
  std::vector<double> weights;          // their weights in the region, above 0
  // The move of vertex i to the fit of degree d is at [i (degree + 1) + d].
  std::vector<Vec3> moves;
  std::size_t caps = 0;       // number of caps that cover the region
  std::size_t unreached = 0;  // number of vertices that no cap sees: they stay
};

// Covers the region with caps and fits them: the slow part. Throws InvalidInput for a wavelength
// that is not above the mesh's spacing there or longer than its diagonal, for a region too wide to
// be bridged, and errors of region_weights().
Patch analyze_patch(const Mesh& mesh, std::span<const Region> regions, const PatchOptions& options,
                    const Context& context = {});

// Settings that update() applies quickly, for example while a slider moves.
struct PatchUpdate {
  double wavelength = 0;  // 0: of the analysis; up to longest_wavelength()
  double strength = 1;    // 0 changes nothing, 1 removes the detail, -1 doubles it
};

// Lists the fields of PatchUpdate (fields.h). The program allows strengths in the chosen bounds.
template <typename Visitor>
void visit_fields(FieldsOf<PatchUpdate>, const Visitor& field) {
  using U = PatchUpdate;
  field(&U::wavelength, {.name = "wavelength",
                         .help = "wavelength below which detail is removed; 0: the wavelength that "
                                 "the fits were made for",
                         .value = "W",
                         .least = 0,
                         .in_program = false,
                         .in_python = false});
  field(&U::strength,
        {.name = "strength",
         .help = "strength of the smoothing; 1 removes the detail, 0.5 half of it, -1 doubles it",
         .value = "S",
         .least = -10,
         .most = 1});
}

// Returns the wavelength of the lowest fitted degree.
double longest_wavelength(const Patch& patch);

// Returns new positions of patch.vertices. Throws InvalidInput for a wavelength outside of the
// analysis, or a strength that is not finite.
std::vector<Vec3> update(const Patch& patch, const PatchUpdate& wanted = {});

// Moves the patch's vertices to `positions`, and updates normals nx, ny, nz of the mesh.
void apply(const Patch& patch, std::span<const Vec3> positions, Mesh& mesh);

}  // namespace rholm
