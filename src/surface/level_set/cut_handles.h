// Cuts handles and tunnels that are smaller than the points resolve (method 7.9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// Distance at which points, or a grid, distinguish two places.
struct Resolution {
  double typical = 0;
  std::function<double(const Vec3&)> at;  // called by several threads
  // If given, receives in advance all places that `at` will be asked for.
  std::function<void(const std::vector<Vec3>&)> foresee = {};
};

struct CutHandles {
  std::size_t handles = 0;
  std::vector<std::uint32_t> copies;  // original vertex of each vertex appended to the mesh
};

// Connections outside a part of a closed surface. Each pair joins a
// vertex of the part to one of the `n` connected pieces outside it.
struct JoinedOutside {
  std::uint32_t n = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;
};

// Acts as cut_handles() below on a part of a mesh. `places` are vertices of tight places
// within length_of_tight_places(), and the part includes all within reach_of_cuts() of them.
// `outside` is called at most once, when something is cut; if empty, the part is the whole.
CutHandles cut_handles_at(Mesh& mesh, std::vector<std::uint32_t> places,
                          const Resolution& resolution,
                          const std::function<JoinedOutside()>& outside, const Context& context);
double length_of_tight_places(double typical);
double reach_of_cuts(double typical);

// Returns the places near which something is cut, if the cut keeps the
// surface connected. Without the other places cut_handles_at() gives the same
// result. The mesh must include all within reach_of_cuts() of the places.
std::vector<std::uint32_t> places_to_cut(const Mesh& mesh, const std::vector<std::uint32_t>& places,
                                         const Resolution& resolution, const Context& context);

// Cuts a closed surface with normals nx, ny, nz along loops of at most five resolutions. A
// loop surrounds a bridge between sheets or a hole through a thin sheet. The surface must
// open on both sides of the loop within three resolutions, so rods stay, and connected
// parts stay connected. Both ends are closed and smoothed; their normals are zero.
CutHandles cut_handles(Mesh& mesh, const Resolution& resolution, const Context& context);

}  // namespace rholm
