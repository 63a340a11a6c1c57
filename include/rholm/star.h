// Is a mesh star-shaped, and from where? Layer: chart. Source: method 6.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/topology.h"

namespace rholm {

// Where the centre is sought.
enum class CenterKind {
  kAuto,      // as kSlope
  kKernel,    // Chebyshev centre of the kernel: maximises the smallest d_T
  kSlope,     // least slope of the radius, well within the kernel (method 6)
  kCosine,    // maximises the smallest cos gamma = n . (v - c) / |v - c| over all corners
  kNone,      // the file's own origin
  kCentroid,  // area-weighted centroid of the surface
  kVolume,    // centroid of the solid; as kSlope where that does not see the whole surface
  kGiven      // CenterOptions::point
};

// Which centre is wanted, and how closely directions are looked at.
struct CenterOptions {
  CenterKind kind = CenterKind::kAuto;  // how it is chosen
  Vec3 point = {};                      // for kGiven
  int rays = 100000;                    // directions tried by check_star; 0 leaves them out
};

// "auto", "kernel", "slope", "cosine", "none", "centroid", "volume" or "X,Y,Z". Throws
// InvalidInput.
CenterOptions parse_center(const std::string& text);
EnumNames names_of(CenterKind kind);  // these names; "given" for a point

// The list of CenterOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CenterOptions>, const Visitor& field) {
  using O = CenterOptions;
  field(&O::kind, {.name = "center",
                   .help = "slope, or auto: where the radius has the least slope, on the line "
                           "through kernel and the centroid of the solid, well within the points "
                           "that see the whole surface; kernel: in the middle of these points; "
                           "cosine: where the surface is seen least aslant; none: the file's "
                           "origin; centroid: of the surface; volume: of the solid, or as slope "
                           "where not all is seen from there",
                   .in_program = false,
                   .in_python = false});
  field(&O::point, {.name = "point",
                    .help = "of the kind given, which the program and Python write in its place",
                    .in_program = false,
                    .in_python = false});
  field(&O::rays, {.name = "rays",
                   .help = "directions that are tried to see how often they meet the surface; 0 "
                           "tries none",
                   .value = "N",
                   .least = 0,
                   .most = 100'000'000});
}

// How a mesh is seen from a centre.
struct StarReport {
  Vec3 center;  // in the coordinates of the mesh
  // min over triangles of d_T = n_T . (v - c): the distance of the nearest face plane, negative if
  // some face turns its back to the centre. For kKernel this is the radius of the kernel's
  // inscribed ball. In the shape's unit.
  double min_d = 0;
  double min_cos_gamma = 0;       // over all corners of all triangles
  std::size_t bad_triangles = 0;  // with d_T <= 0 (beyond rounding)
  bool star_shaped = false;       // bad_triangles == 0 and every direction covered once
  int rays = 0;                   // directions tried: a Fibonacci lattice
  double once_share = 0;          // part of them that meet the surface exactly once
  double multiple_share = 0;      // part that meet it more than once
  double missed_share = 0;        // part that never meet it
  bool center_fell_back = false;  // of kinds that seek it, the kernel is empty: the centre is the
                                  // better of the LP's point and the volume centroid, by once_share
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<StarReport>, const Visitor& field) {
  using S = StarReport;
  field(&S::center, {.name = "center", .help = "in the coordinates of the mesh, (3,)"});
  field(&S::min_d,
        {.name = "min_d",
         .help = "distance of the nearest face plane; negative if a face turns its back"});
  field(&S::min_cos_gamma, {.name = "min_cos_gamma", .help = "over all corners of all triangles"});
  field(&S::bad_triangles, {.name = "bad_triangles", .help = "triangles that turn their backs"});
  field(&S::star_shaped,
        {.name = "star_shaped", .help = "no such triangle, and every direction covered once"});
  field(&S::rays, {.name = "rays", .help = "directions tried"});
  field(&S::once_share, {.name = "once_share", .help = "part of them that meet the surface once"});
  field(&S::multiple_share, {.name = "multiple_share", .help = "part that meet it more than once"});
  field(&S::missed_share, {.name = "missed_share", .help = "part that never meet it"});
  field(&S::center_fell_back,
        {.name = "center_fell_back",
         .help = "whether no point sees all faces, and the centre is the best guess"});
}

// Finds the centre and checks. `mesh` welded, closed, outward; triangles thinner than rounding
// are passed over. Throws InvalidInput for a mesh without a triangle of positive area.
StarReport find_center(const Mesh& mesh, const CenterOptions& options, const Context& context = {});
// The same for a mesh where it lies; nothing is copied, but for rays if it is not closed.
StarReport find_center(const MeshView& mesh, const CenterOptions& options,
                       const Context& context = {});

// The check alone, from a given centre.
StarReport check_star(const Mesh& mesh, const Vec3& center, int rays, const Context& context = {});
StarReport check_star(const MeshView& mesh, const Vec3& center, int rays,
                      const Context& context = {});

// A mesh seen from a centre: what the transforms work on. Vertices are relative to the centre.
struct StarChart {
  Mesh mesh;  // welded, closed, outward, vertices relative to report.center; no attributes
  std::vector<Edge> edges;  // of the mesh, as pair_edges() gives them
  StarReport report;        // the centre, and how well it sees the surface
};

// Which centre, and which surfaces.
struct ChartOptions {
  CenterOptions center = {};  // sought, or given
  bool allow_signed = false;  // accept a surface that is not star-shaped: the signed sum
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ChartOptions>, const Visitor& field) {
  using O = ChartOptions;
  field(&O::center, {.name = "center",
                     .help = "of the expansion, sought or given",
                     .in_program = false,
                     .in_python = false});
  field(&O::allow_signed,
        {.name = "signed",
         .help = "accept a surface that is not star-shaped: the signed sum of its radii, to "
                 "compare such sums or as a descriptor; it does not give back the body, an atlas "
                 "of caps does"});
}

// Pairs the edges, finds the centre, checks, and moves the centre to the origin. `mesh` welded and
// outward. Throws InvalidInput if it is not closed and consistently oriented, NotStarShaped with
// the figures of the report if it is not star-shaped and that is not allowed.
StarChart make_star_chart(const Mesh& mesh, const ChartOptions& options = {},
                          const Context& context = {});
// The same with the edges of pair_edges(mesh) at hand.
StarChart make_star_chart(const Mesh& mesh, std::vector<Edge> edges, const ChartOptions& options,
                          const Context& context = {});

}  // namespace rholm
