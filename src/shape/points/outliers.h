// Points that belong to no surface (method 7.4). Layer: shape.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

// One flag per point, in the order of the tree: 1 for a point whose neighbours' normals disagree
// with its own (unit, in the same order), that lies off the planes of its neighbours, or that is
// much farther from them than they are from theirs. `noise` is the standard deviation of the points
// about the surface: within it nothing is off. Once the ones found are gone, a second and a third
// look find those that they have hidden.
std::vector<std::uint8_t> find_outliers(const PointTree& tree, std::span<const Vec3> points,
                                        std::span<const Vec3> normals, double noise,
                                        const Context& context = {});

// The share of the points whose normals have nothing to do with those around, which are of one
// mind: of some of the points. Of a clean shape hardly any, however thin and sharp: where its
// normals differ, their neighbours' do among each other.
double share_of_wrong_normals(const PointTree& tree, std::span<const Vec3> normals,
                              const Context& context = {});

// The same of one point.
bool has_wrong_normal(const PointTree& tree, std::span<const Vec3> normals, std::size_t point,
                      std::vector<Neighbor>& near);

// One flag per point: 1 for a point of a group of fewer than `least`. Points are of one group if
// they are near neighbours, as near as both have others, and their normals agree.
std::vector<std::uint8_t> find_small_groups(const PointTree& tree, std::span<const Vec3> normals,
                                            std::size_t least, const Context& context = {});

// Calls visit(i, j) for near neighbours that are of one group, on one thread.
void for_links_of_groups(const PointTree& tree, std::span<const Vec3> normals,
                         const std::function<void(std::uint32_t, std::uint32_t)>& visit,
                         const Context& context = {});

}  // namespace rholm
