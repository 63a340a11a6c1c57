// Splits the search of the centre and the star check into parts, for callers that check the faces
// in their own pass. Source: method 6. Layer: chart.
#pragma once

#include "chart/center/local_view.h"
#include "rholm/context.h"
#include "rholm/star.h"

namespace rholm {

struct FoundCenter {
  Vec3 point;  // in the shape's coordinates
  // True if the kernel is sought and empty; then find_center() also tries the solid's centroid.
  bool kernel_empty = false;
  double scans = 0;  // passes over all triangles; a pass over part of them counts in part
};

// Searches the centre, without a check whether the surface is star-shaped from there. options.rays
// is not used.
FoundCenter search_center(const LocalView& view, const CenterOptions& options,
                          const Context& context);

// Returns the better report where the kernel is empty: `program`, the report of the centre found by
// linear programming, or the report of the centroid of the solid.
StarReport better_center(const LocalView& view, const StarReport& program, int rays,
                         const Context& context);

// Computes the first half of a star chart for a mesh whose edges are paired: seeks the centre and
// checks it. Throws NotStarShaped as for a star chart.
StarReport seen_surface(const Mesh& mesh, const ChartOptions& options, const Context& context);

// Does the same as check_star() in rholm/star.h, for a view.
StarReport check_star(const LocalView& view, const Vec3& center, int rays, const Context& context);

}  // namespace rholm
