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

// A mesh in which coinciding vertices are merged.
struct Welded {
  Mesh mesh;                        // mesh with the remaining vertices
  std::size_t merged_vertices = 0;  // removed vertices
  std::size_t collapsed_faces = 0;  // faces dropped because two corners were merged
};

// Merges vertices. Tolerance 0 merges bit-identical ones (0 and -0 are equal).
// Otherwise vertices within `tolerance` (same unit) of each other are merged, chains
// included; the first in file order stays and keeps its attributes. Vertices keep
// their order; unused ones are dropped. Faces with two equal corners are dropped and
// counted.
Welded weld(const Mesh& mesh, double tolerance = 0);

// An edge between two faces. `left` has the half-edge a -> b, `right` has b -> a.
struct Edge {
  std::uint32_t a = 0, b = 0;         // vertex indices
  std::uint32_t left = 0, right = 0;  // face indices
};

// Returns all edges of a closed, consistently oriented mesh, each once, ordered by (min, max)
// vertex. If 2k faces share one edge, opposite half-edges are paired in file order. Throws
// InvalidInput, with the number of wrong edges, if a half-edge has no partner.
std::vector<Edge> pair_edges(const Mesh& mesh);

// A box with sides along the axes.
struct Bounds {
  Vec3 min, max;  // the corners with the smallest and the largest coordinates
  // Returns the diagonal. Right for all coordinates up to a quarter of the largest double.
  double diagonal() const {
    const Vec3 size = max - min;
    const double plain = norm(size);
    return plain > 1e-150 && plain < 1e150 ? plain : std::hypot(std::hypot(size.x, size.y), size.z);
  }
};
// Lists the fields of Bounds (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<Bounds>, const Visitor& field) {
  using B = Bounds;
  field(&B::min, {.name = "min", .help = "corner with the smallest coordinates"});
  field(&B::max, {.name = "max", .help = "corner with the largest coordinates"});
}

Bounds bounds(const std::vector<Vec3>& points);  // {0,0,0} twice for no points

// Properties of a mesh. Counts are of the given mesh: weld it first to close seams.
struct Inspection {
  std::size_t vertices = 0, faces = 0;    // used or not, with an area or not
  std::size_t edges = 0;                  // pairs of vertices joined by a face
  std::size_t boundary_edges = 0;         // edges of one face only
  std::size_t non_manifold_edges = 0;     // edges of three or more faces
  std::size_t misoriented_edges = 0;      // edges that two faces use in the same direction
  std::size_t non_manifold_vertices = 0;  // vertices whose faces do not form one fan
  std::size_t isolated_vertices = 0;      // vertices without faces
  std::size_t degenerate_faces = 0;       // thinner than the rounding of their coordinates
  std::size_t duplicate_faces = 0;        // same three vertices as an earlier face
  std::size_t components = 0;             // parts of faces connected through edges
  long long euler_characteristic = 0;     // used vertices - edges + faces
  std::size_t genus = 0;    // sum over the components; meaningful if closed and manifold
  bool closed = false;      // no boundary edge, at least one face
  bool manifold = false;    // no non-manifold edge or vertex
  bool oriented = false;    // no misoriented edge
  bool inside_out = false;  // closed and oriented, but the enclosed volume is negative
  Bounds bounds;            // bounding box of all vertices
  double area = 0;          // sum over all faces
  double volume = 0;        // signed; meaningful if closed and oriented
  Vec3 vertex_centroid;     // mean of the used vertices
  Vec3 volume_centroid;     // centroid of the solid; meaningful if closed with volume
};
// Lists the fields of Inspection.
template <typename Visitor>
void visit_fields(FieldsOf<Inspection>, const Visitor& field) {
  using I = Inspection;
  field(&I::vertices, {.name = "vertices", .help = "number of vertices, used or not"});
  field(&I::faces, {.name = "faces", .help = "number of faces, with an area or not"});
  field(&I::edges, {.name = "edges", .help = "number of pairs of vertices that a face joins"});
  field(&I::boundary_edges, {.name = "boundary_edges", .help = "number of edges of only one face"});
  field(&I::non_manifold_edges,
        {.name = "non_manifold_edges", .help = "number of edges of three or more faces"});
  field(&I::misoriented_edges,
        {.name = "misoriented_edges",
         .help = "number of edges that two faces use in the same direction"});
  field(&I::non_manifold_vertices, {.name = "non_manifold_vertices",
                                    .help = "number of vertices whose faces do not form one fan"});
  field(&I::isolated_vertices,
        {.name = "isolated_vertices", .help = "number of vertices that no face uses"});
  field(&I::degenerate_faces,
        {.name = "degenerate_faces",
         .help = "number of faces thinner than the rounding of their coordinates"});
  field(&I::duplicate_faces,
        {.name = "duplicate_faces",
         .help = "number of faces with the same three vertices as an earlier face"});
  field(&I::components, {.name = "components", .help = "number of parts connected through edges"});
  field(&I::euler_characteristic,
        {.name = "euler_characteristic", .help = "number of used vertices minus edges plus faces"});
  field(&I::genus, {.name = "genus",
                    .help = "number of handles of all parts together, for closed manifold meshes"});
  field(&I::closed,
        {.name = "closed", .help = "true if the mesh has at least one face and no boundary edge"});
  field(&I::manifold,
        {.name = "manifold", .help = "true if the mesh has no non-manifold edge or vertex"});
  field(&I::oriented, {.name = "oriented", .help = "true if the mesh has no misoriented edge"});
  field(&I::inside_out,
        {.name = "inside_out",
         .help = "true if the mesh is closed and oriented, but encloses a negative volume"});
  field(&I::bounds, {.name = "bounds", .help = "bounding box of all vertices"});
  field(&I::area,
        {.name = "area", .help = "area of all faces, in the squared unit of the vertices"});
  field(&I::volume,
        {.name = "volume",
         .help = "signed volume of a closed oriented mesh, in the cubed unit of the vertices"});
  field(&I::vertex_centroid, {.name = "vertex_centroid", .help = "mean of the used vertices"});
  field(&I::volume_centroid,
        {.name = "volume_centroid",
         .help = "centroid of the solid, if the mesh is closed and its volume is not zero"});
}

// Counts and measures. Throws InvalidInput as validate().
Inspection inspect(const Mesh& mesh);

// Returns the tolerance, in the mesh's unit and with two digits, at which weld() joins the borders
// of an open mesh: none remain, or less than a tenth. Nothing for a closed mesh, or if no tolerance
// below half the median length of border edges suffices. `mesh` is welded exactly.
std::optional<double> closing_tolerance(const Mesh& mesh);

// Returns the component of largest area (faces connected through edges; weld first to close seams),
// welded as by weld(mesh, 0). Among equal areas the first.
Mesh largest_component(const Mesh& mesh);

// Reverses every face and the sign of the normals nx, ny, nz among the attributes.
void flip(Mesh& mesh);

// Returns at each vertex the sum of its faces' normals, each as long as twice the face's area. The
// sum is not normalised, and zero without faces. Indices must be below the number of vertices.
std::vector<Vec3> area_normals(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

// Returns the sum of the areas of the faces.
double surface_area(const Mesh& mesh);
// Returns the signed volume of a closed mesh: positive if counter-clockwise from outside.
double enclosed_volume(const Mesh& mesh);

}  // namespace rholm
