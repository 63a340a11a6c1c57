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

// Returns the share of points (estimated from some) whose normals differ from those around them,
// although these agree with each other. It is almost 0 for a clean shape, however thin and sharp,
// because where its normals differ, the neighbours' normals differ among each other too.
double share_of_wrong_normals(const PointTree& tree, std::span<const Vec3> normals,
                              const Context& context = {});

// Returns true if the normal of one point differs from the agreeing normals around it.
bool has_wrong_normal(const PointTree& tree, std::span<const Vec3> normals, std::size_t point,
                      std::vector<Neighbor>& near);

// Returns one flag per point: 1 for a point of a group of fewer than `least` points. Near
// neighbours, by the spacing of both, are of one group if their normals agree.
std::vector<std::uint8_t> find_small_groups(const PointTree& tree, std::span<const Vec3> normals,
                                            std::size_t least, const Context& context = {});

// Calls visit(i, j) for near neighbours of one group, on one thread.
void for_links_of_groups(const PointTree& tree, std::span<const Vec3> normals,
                         const std::function<void(std::uint32_t, std::uint32_t)>& visit,
                         const Context& context = {});

}  // namespace rholm
