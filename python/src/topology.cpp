// Edges, welding, inspection, repair, simplification, and test shapes.
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
  Record<Bounds>(m, "Bounds", "A box with sides along the axes.")
      .fields()
      .property(
          "diagonal", [](const Bounds& b) { return b.diagonal(); }, "Length of the diagonal.");
  Record<Inspection>(
      m, "Inspection",
      "Properties of a mesh. Counts are of the given mesh: weld it first to close seams.")
      .fields();
  Record<RepairReport>(m, "RepairReport", "Report of `repair`: changes, and defects that remain.")
      .fields();
}

void bind_edges(nb::module_& m) {
  m.def("weld", [](const Mesh& mesh, double tolerance) {
    Welded welded = unlocked([&] { return weld(mesh, tolerance); });
    return nb::make_tuple(std::move(welded.mesh), welded.merged_vertices, welded.collapsed_faces);
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
    return array_of(unlocked([&] { return area_normals(mesh.vertices, mesh.faces); }));
  });
  m.def("surface_area", unlocked_function(&surface_area));
  m.def("enclosed_volume", unlocked_function(&enclosed_volume));
}

void bind_repair(nb::module_& m) {
  Options<RepairOptions>(m, "RepairOptions", "Options of `repair`.").fields();
  m.def("repair", [](const Mesh& mesh, const RepairOptions& options, const Caller& caller) {
    Repaired repaired =
        caller.run([&](const Context& context) { return repair(mesh, options, context); });
    return nb::make_tuple(std::move(repaired.mesh), repaired.report);
  });
  Options<SimplifyOptions>(m, "SimplifyOptions", "Options of `simplify`: when it stops.").fields();
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
