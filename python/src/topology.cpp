// Edges, welding, inspection, repair, fewer triangles, shapes with a known answer.
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/mesh_view.h"
#include "rholm/outward.h"
#include "rholm/polygon.h"
#include "rholm/primitives.h"
#include "rholm/repair.h"
#include "rholm/simplify.h"
#include "rholm/topology.h"

namespace rholm::python {
namespace {

// The corners of polygons of one size, a row each; indices are below the number of points.
using Polygons = nb::ndarray<const std::uint32_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

void bind_records(nb::module_& m) {
  Record<Bounds>(m, "Bounds", "A box along the axes.")
      .field("min", &Bounds::min, "The corner with the smallest coordinates, (3,) float64.")
      .field("max", &Bounds::max, "The corner with the largest, (3,) float64.")
      .property(
          "diagonal", [](const Bounds& b) { return b.diagonal(); }, "Its length.");
  Record<Inspection>(
      m, "Inspection",
      "What a mesh is. Counts are those of the mesh given: weld first to close seams.")
      .field("vertices", &Inspection::vertices, "Number of vertices, used or not.")
      .field("triangles", &Inspection::triangles, "Number of triangles, with an area or not.")
      .field("edges", &Inspection::edges, "Pairs of vertices that a triangle joins.")
      .field("boundary_edges", &Inspection::boundary_edges, "Edges in one triangle only.")
      .field("non_manifold_edges", &Inspection::non_manifold_edges,
             "Edges in three triangles or more.")
      .field("misoriented_edges", &Inspection::misoriented_edges,
             "Edges in two triangles that run through them in the same sense.")
      .field("non_manifold_vertices", &Inspection::non_manifold_vertices,
             "Vertices whose triangles do not form one fan.")
      .field("isolated_vertices", &Inspection::isolated_vertices, "Vertices in no triangle.")
      .field("degenerate_triangles", &Inspection::degenerate_triangles,
             "Triangles thinner than the rounding of their coordinates.")
      .field("duplicate_triangles", &Inspection::duplicate_triangles,
             "Triangles with the three vertices of an earlier one.")
      .field("components", &Inspection::components, "Parts connected through edges.")
      .field("euler_characteristic", &Inspection::euler_characteristic,
             "Used vertices - edges + triangles.")
      .field("genus", &Inspection::genus,
             "Handles, of all parts together; of closed manifold meshes.")
      .field("closed", &Inspection::closed, "No boundary edge, at least one triangle.")
      .field("manifold", &Inspection::manifold, "No non-manifold edge or vertex.")
      .field("oriented", &Inspection::oriented, "No misoriented edge.")
      .field("inside_out", &Inspection::inside_out,
             "Closed and oriented, but the enclosed volume is negative.")
      .field("bounds", &Inspection::bounds, "Of all vertices.")
      .field("area", &Inspection::area, "Of all triangles, in the squared unit of the vertices.")
      .field("volume", &Inspection::volume, "Signed, of closed oriented meshes, in the cubed unit.")
      .field("vertex_centroid", &Inspection::vertex_centroid, "Mean of the used vertices, (3,).")
      .field("volume_centroid", &Inspection::volume_centroid, "Of the solid, (3,).");
  Record<RepairReport>(m, "RepairReport", "What was done to a mesh, and what could not be.")
      .field("before", &RepairReport::before, "Inspection of the mesh welded exactly.")
      .field("merged_vertices", &RepairReport::merged_vertices, "Vertices merged by welding.")
      .field("collapsed_triangles", &RepairReport::collapsed_triangles,
             "Triangles of which welding made two corners one.")
      .field("isolated_vertices", &RepairReport::isolated_vertices,
             "Vertices dropped: in no triangle.")
      .field("duplicate_triangles", &RepairReport::duplicate_triangles,
             "Triangles dropped: same vertices as an earlier one.")
      .field("degenerate_triangles", &RepairReport::degenerate_triangles,
             "Triangles thinner than rounding, dropped or swapped.")
      .field("junctions", &RepairReport::junctions,
             "Vertices on edges of others' triangles (T-junctions), joined.")
      .field("flipped_triangles", &RepairReport::flipped_triangles, "Triangles that were turned.")
      .field("inside_out_parts", &RepairReport::inside_out_parts,
             "Closed parts that were turned as a whole.")
      .field("cavities", &RepairReport::cavities, "Closed parts within another: they face inwards.")
      .field("split_vertices", &RepairReport::split_vertices,
             "New vertices where sheets met in one.")
      .field("closed_holes", &RepairReport::closed_holes, "Holes closed by new triangles.")
      .field("hole_triangles", &RepairReport::hole_triangles, "Triangles put into them.")
      .field("large_holes", &RepairReport::large_holes, "Holes left: more edges than allowed.")
      .field("largest_hole", &RepairReport::largest_hole, "Edges of the largest of these.")
      .field("sheets", &RepairReport::sheets, "Holes left: borders of open sheets.")
      .field("one_sided_parts", &RepairReport::one_sided_parts,
             "Parts left without an orientation (Moebius strips).")
      .field("closes_at", &RepairReport::closes_at,
             "The tolerance of welding that would join the borders left, or None.")
      .field("after", &RepairReport::after, "Inspection of the result.");
}

void bind_edges(nb::module_& m) {
  m.def("weld", [](const Mesh& mesh, double tolerance) {
    Welded welded = unlocked([&] { return weld(mesh, tolerance); });
    return nb::make_tuple(std::move(welded.mesh), welded.merged_vertices,
                          welded.collapsed_triangles);
  });
  m.def("pair_edges", [](const Mesh& mesh) {
    static_assert(sizeof(Edge) == 4 * sizeof(std::uint32_t));
    std::vector<Edge> edges = unlocked([&] { return pair_edges(mesh); });
    const std::size_t n = edges.size();
    return array_of<std::uint32_t>(std::move(edges), {n, 4});
  });
  m.def("cut_polygons", [](const Rows& points, const Polygons& polygons) {
    const std::vector<Vec3> vertices = vector_of(points);
    const std::size_t corners = polygons.shape(1);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < polygons.shape(0); ++i) {
      triangulate_polygon(vertices, {polygons.data() + i * corners, corners}, triangles);
    }
    const std::size_t n = triangles.size();
    return array_of<std::uint32_t>(std::move(triangles), {n, 3});
  });
  m.def("bounds", [](const Rows& points) { return bounds(vector_of(points)); });
  m.def("inspect", unlocked_function(&inspect));
  m.def("outward",
        [](const Mesh& mesh) { return unlocked([&] { return outward(mesh).welded.mesh; }); });
  m.def("closing_tolerance", unlocked_function(&closing_tolerance));
  m.def("largest_component", unlocked_function(&largest_component));
  m.def("flip", [](Mesh mesh) {
    flip(mesh);
    return mesh;
  });
  m.def("area_normals", [](const Mesh& mesh) {
    return array_of(unlocked([&] { return area_normals(mesh.vertices, mesh.triangles); }));
  });
  m.def("surface_area", unlocked_function(&surface_area));
  m.def("enclosed_volume", unlocked_function(&enclosed_volume));
}

void bind_repair(nb::module_& m) {
  m.def("repair", [](const Mesh& mesh, double weld, std::size_t max_hole, const Caller& caller) {
    Repaired repaired = caller.run([&](const Context& context) {
      return repair(mesh, {.weld = weld, .max_hole = max_hole}, context);
    });
    return nb::make_tuple(std::move(repaired.mesh), repaired.report);
  });
  Options<SimplifyOptions>(m, "SimplifyOptions", "Where simplify() stops.").fields();
  m.def("simplify", [](const Mesh& mesh, const SimplifyOptions& options, const Caller& caller) {
    Simplification result =
        caller.run([&](const Context& context) { return simplify(mesh, options, context); });
    return nb::make_tuple(std::move(result.mesh), result.error);
  });
}

void bind_primitives(nb::module_& m) {
  m.def("icosphere", unlocked_function(&icosphere));
  m.def("latitude_longitude_sphere", unlocked_function(&latitude_longitude_sphere));
  m.def("ellipsoid", unlocked_function(&ellipsoid));
  m.def("box", unlocked_function(&box));
  m.def("torus", unlocked_function(&torus));
  m.def("bumpy_sphere", unlocked_function(&bumpy_sphere));
}

}  // namespace

void bind_topology(nb::module_& m) {
  bind_records(m);
  bind_edges(m);
  bind_repair(m);
  bind_primitives(m);
}

}  // namespace rholm::python
