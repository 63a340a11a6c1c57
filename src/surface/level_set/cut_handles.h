// Bridges and tunnels that are smaller than points can tell (method 7.9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// The distance at which points, or a grid, tell one place from another.
struct Resolution {
  double typical = 0;
  std::function<double(const Vec3&)> at;  // asked by several threads
  // If given, called with all places that will be asked for, before they are.
  std::function<void(const std::vector<Vec3>&)> foresee = {};
};

struct CutHandles {
  std::size_t handles = 0;
  std::vector<std::uint32_t> copies;  // of which given vertices the mesh's last ones are copies
};

// Of a part of a closed surface: pairs of one of its vertices and a number below `n`, of a
// connected piece of what is not in the part, that the vertex is joined to.
struct JoinedOutside {
  std::uint32_t n = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;
};

// As cut_handles() below, in a part that has all that is within reach_of_cuts() of these vertices,
// which are those of tight places within length_of_tight_places(). `outside` is asked for at most
// once, where something is to be cut; none: the part is the whole.
CutHandles cut_handles_at(Mesh& mesh, std::vector<std::uint32_t> places,
                          const Resolution& resolution,
                          const std::function<JoinedOutside()>& outside, const Context& context);
double length_of_tight_places(double typical);
double reach_of_cuts(double typical);

// Those of the places near which there is something to be cut, if that does not part the surface:
// without the others cut_handles_at() finds the same. The mesh must have
// all within reach_of_cuts() of the places.
std::vector<std::uint32_t> places_to_cut(const Mesh& mesh, const std::vector<std::uint32_t>& places,
                                         const Resolution& resolution, const Context& context);

// Cuts a closed surface with normals nx, ny, nz where a loop of at most five resolutions goes
// around or through something, if the surface opens on both sides of it within three: bridges
// between sheets, holes through thin ones. Rods and their like stay, and the parts stay whole. Both
// ends are closed and made smooth; normals there are zero.
CutHandles cut_handles(Mesh& mesh, const Resolution& resolution, const Context& context);

}  // namespace rholm
