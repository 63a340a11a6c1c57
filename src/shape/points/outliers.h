// Finds points that belong to no surface (method 7.4). Layer: shape.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Returns one flag per point, in the order of the tree, from unit normals in the same order. It is
// 1 if the normal disagrees with the neighbours' normals, or the point lies off their planes. It is
// also 1 if the point is much farther from its neighbours than they are from theirs. `noise` is the
// standard deviation of the points about the surface; distances within it do not count. Each call
// makes one pass: after a removal, another call can find outliers that were hidden.
std::vector<std::uint8_t> find_outliers(const PointTree& tree, std::span<const Vec3> points,
                                        std::span<const Vec3> normals, double noise,
                                        const Context& context = {});

// Returns true if the normal of a point differs from the normals around it, although these agree
// with each other. This is rare on a clean shape, however thin and sharp, because where its normals
// differ, the neighbours' normals differ among each other too. `near` is reused memory.
bool has_wrong_normal(const PointTree& tree, std::span<const Vec3> normals, std::size_t point,
                      std::vector<Neighbor>& near);

// Calls visit(i, j), on one thread, for near neighbours of one group. Near neighbours, by the
// spacing of both, are of one group if their normals agree.
void for_links_of_groups(const PointTree& tree, std::span<const Vec3> normals,
                         const std::function<void(std::uint32_t, std::uint32_t)>& visit,
                         const Context& context = {});

}  // namespace rholm
