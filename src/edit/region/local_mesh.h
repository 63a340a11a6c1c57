// Part of a mesh that an edit reads. Layer: edit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/topology.h"
#include "shape/topology/vertex_stars.h"

namespace rholm {

// Vertices with identical coordinates are one point, so
// that a seam of the file is no seam of the surface.
struct LocalMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> faces;         // triangles of points; none with a repeated corner
  std::vector<Vec3> normals;           // unit, weighted by area; zero where there is no area
  std::vector<double> areas;           // a third of the area of the triangles around each point
  VertexStars stars;                   // triangles around each point
  std::vector<std::uint32_t> members;  // vertices of the mesh at each point
  std::vector<std::uint32_t> members_begin;

  std::span<const std::uint32_t> triangles_at(std::size_t point) const { return stars.of(point); }
  std::span<const std::uint32_t> members_of(std::size_t point) const {
    return std::span(members).subspan(members_begin[point],
                                      members_begin[point + 1] - members_begin[point]);
  }
};

// A mesh cannot represent waves shorter than this number of edges.
inline constexpr double kFewestEdges = 2;

// Returns the median length of edges that leave points of weight > 0; 0 if there are none.
double median_edge(std::span<const Vec3> points, std::span<const Triangle> triangles,
                   std::span<const double> weights);

// Cuts out the triangles with a corner in the box, with all their corners.
LocalMesh cut_out(const Mesh& mesh, const Bounds& box);

// Returns unit normals at the points, weighted by area, for the points' given positions.
std::vector<Vec3> point_normals(const LocalMesh& local, std::span<const Vec3> positions);

// Recomputes the normal attributes (nx, ny, nz) of the mesh at these vertices.
void update_normals(Mesh& mesh, std::span<const std::uint32_t> vertices);

// Computes distances along the surface by fast marching (Kimmel, Sethian 1998; the distance
// to a source unfolded into the plane replaces the plane wave). On input `distance` has the
// values of the sources, and infinity elsewhere; it is filled up to `limit`.
void march(const LocalMesh& local, double limit, std::vector<double>& distance);

}  // namespace rholm
