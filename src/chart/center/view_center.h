// The centre and the star check in parts, for those who check the faces on a pass of their own.
// Source: method 6. Layer: chart.
#pragma once

#include "chart/center/local_view.h"
#include "rholm/context.h"
#include "rholm/star.h"

namespace rholm {

struct FoundCenter {
  Vec3 point;  // in the shape's coordinates
  // Of kinds that seek the kernel: find_center() weighs this point against the volume's.
  bool kernel_empty = false;
  double scans = 0;  // passes over all triangles; those over some of them count in part
};

// The centre alone; whether the surface is star-shaped from there is not asked. options.rays is not
// used.
FoundCenter search_center(const LocalView& view, const CenterOptions& options,
                          const Context& context);

// Where the kernel is empty: the report of the better of the centre that a program has found, which
// `program` is of, and the centroid of the solid.
StarReport better_center(const LocalView& view, const StarReport& program, int rays,
                         const Context& context);

// The first half of a star chart, for a mesh whose edges are paired: seeks the centre and checks.
// Throws NotStarShaped as the whole does.
StarReport seen_surface(const Mesh& mesh, const ChartOptions& options, const Context& context);

// check_star() of rholm/star.h.
StarReport check_star(const LocalView& view, const Vec3& center, int rays, const Context& context);

}  // namespace rholm
