// The part of a mesh that an edit looks at. Layer: edit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/topology.h"
#include "shape/topology/vertex_stars.h"

namespace rholm {

// Vertices that coincide bit for bit are one point, so that a seam of the file is none of the
// surface.
struct LocalMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;     // of points; none with a repeated corner
  std::vector<Vec3> normals;           // unit, weighted by area; zero where there is no area
  std::vector<double> areas;           // a third of the triangles around each point
  VertexStars stars;                   // triangles around each point
  std::vector<std::uint32_t> members;  // vertices of the mesh at point i, likewise
  std::vector<std::uint32_t> members_begin;

  std::span<const std::uint32_t> triangles_at(std::size_t point) const { return stars.of(point); }
  std::span<const std::uint32_t> members_of(std::size_t point) const {
    return std::span(members).subspan(members_begin[point],
                                      members_begin[point + 1] - members_begin[point]);
  }
};

// Waves shorter than this many edges are not in a mesh.
inline constexpr double kFewestEdges = 2;

// The median length of the edges that leave points of weight > 0; 0 if there are none.
double median_edge(std::span<const Vec3> points, std::span<const Triangle> triangles,
                   std::span<const double> weights);

// Triangles with a corner in the box, and their corners.
LocalMesh cut_out(const Mesh& mesh, const Bounds& box);

// Unit normals at the points when they are at `positions`, weighted by area.
std::vector<Vec3> point_normals(const LocalMesh& local, std::span<const Vec3> positions);

// Normals among the mesh's attributes (nx, ny, nz), made anew at these vertices.
void update_normals(Mesh& mesh, std::span<const std::uint32_t> vertices);

// Distances along the surface by fast marching (Kimmel, Sethian 1998, with the distance to a
// source unfolded into the plane instead of a plane wave): `distance` has those of the sources and
// infinity elsewhere, and is filled as far as `limit`.
void march(const LocalMesh& local, double limit, std::vector<double>& distance);

}  // namespace rholm
