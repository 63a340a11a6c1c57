// Welding, pairing of edges and inspection of triangle meshes. Layer: shape.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

// A mesh whose triangles share vertices.
struct Welded {
  Mesh mesh;                            // with the vertices that stay
  std::size_t merged_vertices = 0;      // vertices that became one with another
  std::size_t collapsed_triangles = 0;  // triangles dropped because two corners became one
};

// Makes vertices that coincide one: bit-identical ones (0 and -0 are the same) for tolerance 0,
// else all whose distance is at most `tolerance` (same unit as the vertices; the relation is closed
// transitively, the first vertex in file order stays). Vertices keep their order; unused ones
// are dropped. Attributes are those of the vertex that stays. Triangles with two equal corners
// are dropped and counted.
Welded weld(const Mesh& mesh, double tolerance = 0);

// An edge between two triangles. `left` has the half-edge a -> b, `right` has b -> a.
struct Edge {
  std::uint32_t a = 0, b = 0;         // vertex indices
  std::uint32_t left = 0, right = 0;  // triangle indices
};

// All edges of a closed, consistently oriented mesh, each once, ordered by (min, max) vertex.
// Where 2k triangles meet in one edge, half-edges of opposite sense are paired in file order.
// Throws InvalidInput, with the number of offending edges, if some half-edge has no partner.
std::vector<Edge> pair_edges(const Mesh& mesh);

// A box along the axes.
struct Bounds {
  Vec3 min, max;  // the corners with the smallest and the largest coordinates
  // Its length. Right for all coordinates up to a quarter of the largest double.
  double diagonal() const {
    const Vec3 size = max - min;
    const double plain = norm(size);
    return plain > 1e-150 && plain < 1e150 ? plain : std::hypot(std::hypot(size.x, size.y), size.z);
  }
};
// Its list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<Bounds>, const Visitor& field) {
  using B = Bounds;
  field(&B::min, {.name = "min", .help = "the corner with the smallest coordinates"});
  field(&B::max, {.name = "max", .help = "the corner with the largest coordinates"});
}

Bounds bounds(const std::vector<Vec3>& points);  // {0,0,0} twice for no points

// What a mesh is. Counts are those of the mesh given: weld first to close seams.
struct Inspection {
  std::size_t vertices = 0, triangles = 0;  // used or not, with an area or not
  std::size_t edges = 0;                    // pairs of vertices that a triangle joins
  std::size_t boundary_edges = 0;           // in one triangle only
  std::size_t non_manifold_edges = 0;       // in three or more
  std::size_t misoriented_edges = 0;      // in two triangles that run through it in the same sense
  std::size_t non_manifold_vertices = 0;  // whose triangles do not form one fan
  std::size_t isolated_vertices = 0;      // in no triangle
  std::size_t degenerate_triangles = 0;   // thinner than the rounding of their coordinates
  std::size_t duplicate_triangles = 0;    // same three vertices as an earlier one
  std::size_t components = 0;             // of triangles connected through edges
  long long euler_characteristic = 0;     // used vertices - edges + triangles
  std::size_t genus = 0;    // summed over the components; meaningful if closed and manifold
  bool closed = false;      // no boundary edge, at least one triangle
  bool manifold = false;    // no non-manifold edge or vertex
  bool oriented = false;    // no misoriented edge
  bool inside_out = false;  // closed and oriented, but the enclosed volume is negative
  Bounds bounds;            // of all vertices
  double area = 0;          // of all triangles
  double volume = 0;        // signed; meaningful if closed and oriented
  Vec3 vertex_centroid;     // mean of the used vertices
  Vec3 volume_centroid;     // of the solid; meaningful if closed and the volume is not zero
};
// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<Inspection>, const Visitor& field) {
  using I = Inspection;
  field(&I::vertices, {.name = "vertices", .help = "number of vertices, used or not"});
  field(&I::triangles, {.name = "triangles", .help = "number of triangles, with an area or not"});
  field(&I::edges, {.name = "edges", .help = "pairs of vertices that a triangle joins"});
  field(&I::boundary_edges, {.name = "boundary_edges", .help = "edges in one triangle only"});
  field(&I::non_manifold_edges,
        {.name = "non_manifold_edges", .help = "edges in three triangles or more"});
  field(&I::misoriented_edges,
        {.name = "misoriented_edges",
         .help = "edges in two triangles that run through them in the same sense"});
  field(&I::non_manifold_vertices,
        {.name = "non_manifold_vertices", .help = "vertices whose triangles do not form one fan"});
  field(&I::isolated_vertices, {.name = "isolated_vertices", .help = "vertices in no triangle"});
  field(&I::degenerate_triangles,
        {.name = "degenerate_triangles",
         .help = "triangles thinner than the rounding of their coordinates"});
  field(&I::duplicate_triangles, {.name = "duplicate_triangles",
                                  .help = "triangles with the three vertices of an earlier one"});
  field(&I::components, {.name = "components", .help = "parts connected through edges"});
  field(&I::euler_characteristic,
        {.name = "euler_characteristic", .help = "used vertices - edges + triangles"});
  field(&I::genus,
        {.name = "genus", .help = "handles, of all parts together; of closed manifold meshes"});
  field(&I::closed, {.name = "closed", .help = "no boundary edge, at least one triangle"});
  field(&I::manifold, {.name = "manifold", .help = "no non-manifold edge or vertex"});
  field(&I::oriented, {.name = "oriented", .help = "no misoriented edge"});
  field(&I::inside_out,
        {.name = "inside_out", .help = "closed and oriented, but the enclosed volume is negative"});
  field(&I::bounds, {.name = "bounds", .help = "box around all vertices"});
  field(&I::area,
        {.name = "area", .help = "of all triangles, in the squared unit of the vertices"});
  field(&I::volume,
        {.name = "volume", .help = "signed, of closed oriented meshes, in the cubed unit"});
  field(&I::vertex_centroid, {.name = "vertex_centroid", .help = "mean of the used vertices"});
  field(&I::volume_centroid, {.name = "volume_centroid",
                              .help = "of the solid, if it is closed and its volume is not zero"});
}

// Counts and measures. Throws InvalidInput as validate() does.
Inspection inspect(const Mesh& mesh);

// The tolerance, in the mesh's unit and with two digits, at which welding joins the borders of an
// open mesh: none are left, or not a tenth of them. None if there is no such tolerance below half
// the median length of an edge of the border, and for a mesh that is closed. `mesh` welded exactly.
std::optional<double> closing_tolerance(const Mesh& mesh);

// The component (of triangles connected through edges, as counted above: weld first to close
// seams) of the largest area, welded as by weld(mesh, 0). Of equal ones the first.
Mesh largest_component(const Mesh& mesh);

// Reverses every triangle. Normals nx, ny, nz among the attributes change sign.
void flip(Mesh& mesh);

// At each vertex the sum of its triangles' normals, each as long as twice the triangle's area: not
// normalised, and zero where no triangle is. Indices of triangles are below the number of vertices.
std::vector<Vec3> area_normals(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

// Sum of the areas of the triangles.
double surface_area(const Mesh& mesh);
// Signed volume of a closed mesh (positive if triangles are counter-clockwise from outside).
double enclosed_volume(const Mesh& mesh);

}  // namespace rholm
