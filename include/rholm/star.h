// Star-shapedness of a mesh, and choice of the centre. Layer: chart. Source: method 6.
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

// Choices of the centre.
enum class CenterKind {
  kAuto,      // same as kSlope
  kKernel,    // Chebyshev centre of the kernel: maximises the smallest d_T
  kSlope,     // least slope of the radius, well within the kernel (method 6)
  kCosine,    // maximises the smallest cos gamma = n . (v - c) / |v - c| over all corners
  kNone,      // origin of the file's coordinates
  kCentroid,  // area-weighted centroid of the surface
  kVolume,    // centroid of the solid; as kSlope if it does not see the whole surface
  kGiven      // CenterOptions::point
};

// Choice of the centre, and number of test directions.
struct CenterOptions {
  CenterKind kind = CenterKind::kAuto;  // choice of the centre
  Vec3 point = {};                      // centre for kGiven
  int rays = 100000;                    // number of directions tested by check_star(); 0: none
};

// Parses "auto", "kernel", "slope", "cosine", "none", "centroid", "volume" or "X,Y,Z". Throws
// InvalidInput.
CenterOptions parse_center(const std::string& text);
EnumNames names_of(CenterKind kind);  // the names above; "given" for a point

// Lists the fields of CenterOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CenterOptions>, const Visitor& field) {
  using O = CenterOptions;
  field(&O::kind,
        {.name = "center",
         .help = "choice of the centre; slope, auto: the point of least slope of the radius, among "
                 "points that see the whole surface (the kernel); kernel: middle of the kernel; "
                 "cosine: the point that sees the surface least obliquely; none: origin of the "
                 "coordinates; centroid: centroid of the surface; volume: centroid of the solid, "
                 "or slope if it does not see the whole surface; given: a given point",
         .in_program = false,
         .in_python = false});
  field(
      &O::point,
      {.name = "point",
       .help =
           "centre for the choice given; the program and Python take the point in place of a name",
       .in_program = false,
       .in_python = false});
  field(&O::rays,
        {.name = "rays",
         .help = "number of directions tested for how often they meet the surface; 0: no test",
         .value = "N",
         .least = 0,
         .most = 100'000'000});
}

// Visibility of a mesh from a centre.
struct StarReport {
  Vec3 center;  // centre in the coordinates of the mesh
  // Smallest d_T = n_T . (v - c) over all faces: the distance to the nearest plane of a face,
  // negative if a face points away from the centre. For kKernel it is the radius of the inscribed
  // ball of the kernel. In the shape's unit.
  double min_d = 0;
  double min_cos_gamma = 0;       // smallest, over all corners of all faces
  std::size_t bad_faces = 0;      // number of faces with d_T <= 0 (beyond rounding)
  bool star_shaped = false;       // no bad face, and every direction meets the surface once
  int rays = 0;                   // number of directions tested: a Fibonacci lattice
  double once_share = 0;          // share of the directions that meet the surface exactly once
  double multiple_share = 0;      // share that meet it more than once
  double missed_share = 0;        // share that never meet it
  bool center_fell_back = false;  // the kernel is empty but was needed: the centre is the LP's
                                  // point or volume centroid, whichever has the larger once_share
};

// Lists the fields of StarReport.
template <typename Visitor>
void visit_fields(FieldsOf<StarReport>, const Visitor& field) {
  using S = StarReport;
  field(&S::center, {.name = "center", .help = "centre in the coordinates of the mesh, (3,)"});
  field(&S::min_d, {.name = "min_d",
                    .help = "smallest distance of the centre from the plane of a face; negative if "
                            "a face points away from the centre"});
  field(&S::min_cos_gamma, {.name = "min_cos_gamma",
                            .help = "smallest cosine of the angle between normal and ray from the "
                                    "centre, over all corners of all faces"});
  field(&S::bad_faces,
        {.name = "bad_faces", .help = "number of faces that point away from the centre"});
  field(&S::star_shaped, {.name = "star_shaped",
                          .help = "true if no face points away from the centre and every direction "
                                  "meets the surface once"});
  field(&S::rays, {.name = "rays", .help = "number of tested directions"});
  field(&S::once_share,
        {.name = "once_share",
         .help = "share of the tested directions that meet the surface exactly once"});
  field(&S::multiple_share,
        {.name = "multiple_share",
         .help = "share of the tested directions that meet the surface more than once"});
  field(&S::missed_share, {.name = "missed_share",
                           .help = "share of the tested directions that never meet the surface"});
  field(&S::center_fell_back,
        {.name = "center_fell_back",
         .help =
             "true if no point sees the whole surface, so that the centre is only the best guess"});
}

// Finds the centre and checks visibility. `mesh` is welded, closed, outward; faces thinner than
// rounding are ignored. Throws InvalidInput for a mesh without a face of positive area.
StarReport find_center(const Mesh& mesh, const CenterOptions& options, const Context& context = {});
// Does the same without a copy of the mesh, except for the test directions if it is not closed.
StarReport find_center(const MeshView& mesh, const CenterOptions& options,
                       const Context& context = {});

// Check visibility from a given centre.
StarReport check_star(const Mesh& mesh, const Vec3& center, int rays, const Context& context = {});
StarReport check_star(const MeshView& mesh, const Vec3& center, int rays,
                      const Context& context = {});

// A mesh relative to its centre: the input of the transforms.
struct StarChart {
  Mesh mesh;  // welded, closed, outward, vertices relative to report.center; no attributes
  std::vector<Edge> edges;  // edges of the mesh from pair_edges()
  StarReport report;        // the centre, and the visibility from it
};

// The centre, and whether surfaces that are not star-shaped are accepted.
struct ChartOptions {
  CenterOptions center = {};  // choice of the centre
  bool allow_signed = false;  // accept a surface that is not star-shaped: the signed sum
};

// Lists the fields of ChartOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ChartOptions>, const Visitor& field) {
  using O = ChartOptions;
  field(&O::center, {.name = "center",
                     .help = "centre of the expansion, searched for or given",
                     .in_program = false,
                     .in_python = false});
  field(&O::allow_signed,
        {.name = "signed",
         .help = "accept a surface that is not star-shaped; the model is the signed sum of its "
                 "radii, a descriptor that does not reproduce the body (use an atlas of caps)"});
}

// Pairs the edges, finds the centre, checks, and moves the centre to the origin. `mesh` is welded
// and outward. Throws InvalidInput if it is not closed and consistently oriented; NotStarShaped,
// with the numbers of the report, if it is not star-shaped and not allow_signed.
StarChart make_star_chart(const Mesh& mesh, const ChartOptions& options = {},
                          const Context& context = {});
// Makes the chart with given edges from pair_edges(mesh).
StarChart make_star_chart(const Mesh& mesh, std::vector<Edge> edges, const ChartOptions& options,
                          const Context& context = {});

}  // namespace rholm
