#include "surface/holes/hole_fill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "surface/holes/close_grid.h"
#include "surface/holes/hermite_rbf.h"
#include "surface/holes/hole_sets.h"

namespace rholm {
namespace {

using std::numbers::pi;

// Centres of the RBF (method 7.10) lie within this part of the hole's radius from its rim.
constexpr double kBorder = 0.4;
// Spacing of centres: in supports of caps, at most 36 around a round hole, wider off the rim.
constexpr double kCapSpacing = 0.6;
constexpr double kAroundRim = 36;
constexpr double kWidening = 0.4;
// A value divided by its slope is a distance, to first order, if the slope is near 1.
constexpr double kLeastSteep = 0.6;
constexpr double kMostSteep = 1.5;
// Factor of the spacing while there are too many centres. Chosen: a few rounds at most.
constexpr double kThinning = 1.2;
// Least number of centres; fewer determine no more than a plane.
constexpr std::size_t kLeastCenters = 6;
// Smaller holes keep the winding number: its roughness there is below a step
// or two, and a surface full of gaps has very many small holes. Chosen.
constexpr std::size_t kLeastNodes = 64;
constexpr double kLeastRadiusSteps = 2.5;
// Least radius of a smooth fill between two sheets. Midway between discs
// missing in both sheets, t apart, the winding number is t / sqrt(t^2 + 4 r^2);
// it bridges them if r >= sqrt(3) / 2 t. Sheets are at least two steps apart.
constexpr double kLeastBridgeSteps = std::numbers::sqrt3;
// Number of rim nodes for distances to a rim: 1/40 of the radius apart on a round hole.
constexpr std::size_t kRimSamples = 256;
// The fill fades to the winding number between these distances, in units of the hole's reach.
constexpr double kFadeFrom = 1.3;
constexpr double kFadeTo = 1.8;
// The winding number determines the sign if it differs from 1/2 by more (method 7.10).
constexpr double kSure = 0.3;
// Where it does not, its bounds are this many times its own values, offset by a step. The
// bounds must not cut values next to the surface, from which the surface is interpolated.
constexpr double kBoundSlope = 2;
// A position is empty if more than this share around it was seen. A line marks each whole
// cube it crosses, so half a cube too much on either side. With 1/2, fills beside a surface
// that lines pass closely lose up to two spacings (scripts/scan-limits --scans, the knot).
constexpr double kEmpty = 0.75;
// Smaller slopes occur at saddles and extrema; no distance follows from them.
constexpr double kLeastSlope = 0.05;
// Fills are cut off at this many steps; larger distances have no meaning.
constexpr double kLargestSteps = 2.5;

bool is_large(const Hole& hole, double step) {
  return hole.nodes.size() >= kLeastNodes && hole.radius >= kLeastRadiusSteps * step;
}

bool may_bridge(const BlockGrid& grid, const Hole& hole) {
  return hole.radius >= kLeastBridgeSteps * grid.step && count_borders(grid, hole) > 1;
}

// Foot points, sorted by the block of grid coordinates in which they lie.
struct FeetOfBlocks {
  std::vector<BlockCoordinates> blocks;  // blocks with foot points
  std::vector<std::uint32_t> first;      // first foot of each block, and the end
  std::vector<std::uint32_t> feet;
};

FeetOfBlocks sort_feet(const BlockGrid& grid, std::span<const FootPoint> feet) {
  FeetOfBlocks result;
  const auto block_of = [&](std::uint32_t f) -> BlockCoordinates {
    const Vec3 p = (feet[f].at - grid.origin) / (8 * grid.step);
    const auto cell = [](double c) {
      return static_cast<std::int32_t>(
          std::floor(std::clamp(c, -1.0 * kBlockLimit, 1.0 * kBlockLimit)));
    };
    return {cell(p.x), cell(p.y), cell(p.z)};
  };
  std::vector<std::pair<BlockCoordinates, std::uint32_t>> sorted;
  for (std::uint32_t f = 0; f < feet.size(); ++f) {
    if (is_finite(feet[f].at)) sorted.emplace_back(block_of(f), f);
  }
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [block, foot] : sorted) {
    if (result.blocks.empty() || result.blocks.back() != block) {
      result.blocks.push_back(block);
      result.first.push_back(static_cast<std::uint32_t>(result.feet.size()));
    }
    result.feet.push_back(foot);
  }
  result.first.push_back(static_cast<std::uint32_t>(result.feet.size()));
  return result;
}

struct Candidate {
  double rim_distance = 0;
  std::uint32_t foot = 0;
};

// Returns the median of the positive supports (the supports of caps), or 0 without any.
double typical_support(std::span<const FootPoint> feet, const std::vector<Candidate>& candidates) {
  std::vector<double> supports;
  for (const Candidate& c : candidates) {
    if (feet[c.foot].support > 0) supports.push_back(feet[c.foot].support);
  }
  if (supports.empty()) return 0;
  const auto middle = supports.begin() + static_cast<std::ptrdiff_t>(supports.size() / 2);
  std::nth_element(supports.begin(), middle, supports.end());
  return *middle;
}

// Returns the foot points near the rim, nearest first.
std::vector<Candidate> candidates_of(const BlockGrid& grid, const Hole& hole,
                                     std::span<const FootPoint> feet, const FeetOfBlocks& feet_of) {
  std::vector<Vec3> rim;
  const std::size_t stride = (hole.rim.size() + kRimSamples - 1) / kRimSamples;
  for (std::size_t i = 0; i < hole.rim.size(); i += stride) {
    rim.push_back(grid.node(hole.rim[i].block, hole.rim[i].node));
  }
  std::vector<Candidate> found, of_grid;
  for (std::size_t b = 0; b < feet_of.blocks.size(); ++b) {
    const BlockCoordinates& block = feet_of.blocks[b];
    const Vec3 middle = grid.origin + grid.step * Vec3{8.0 * block[0] + 3.5, 8.0 * block[1] + 3.5,
                                                       8.0 * block[2] + 3.5};
    if (norm(middle - hole.center) > reach_of_feet(hole, grid.step)) continue;
    for (std::uint32_t i = feet_of.first[b]; i < feet_of.first[b + 1]; ++i) {
      const FootPoint& foot = feet[feet_of.feet[i]];
      double square = std::numeric_limits<double>::infinity();
      for (const Vec3& at : rim) square = std::min(square, dot(at - foot.at, at - foot.at));
      const double d = std::sqrt(square);
      // The foot of a cap may be up to its support away from the rim.
      if (d < kBorder * hole.radius + foot.support) {
        found.push_back({d, feet_of.feet[i]});
      } else if (foot.support == 0) {
        of_grid.push_back({d, feet_of.feet[i]});
      }
    }
  }
  // A hole smaller than the surrounding caps continues their surface. These
  // caps have too few feet, so the grid's surface within a support counts too.
  const double support = typical_support(feet, found);
  if (hole.radius < support) {
    for (const Candidate& c : of_grid) {
      if (c.rim_distance < kBorder * hole.radius + support) found.push_back(c);
    }
  }
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.rim_distance != b.rim_distance ? a.rim_distance < b.rim_distance : a.foot < b.foot;
  });
  return found;
}

// Returns the candidates that keep the spacing from all earlier ones.
std::vector<std::uint32_t> thin_out(const std::vector<Candidate>& candidates, double radius,
                                    std::span<const FootPoint> feet, double widen) {
  std::vector<std::uint32_t> chosen;
  for (const Candidate& c : candidates) {
    const FootPoint& foot = feet[c.foot];
    const double spacing =
        widen * (std::max(kCapSpacing * foot.support, 2 * pi * radius / kAroundRim) +
                 kWidening * c.rim_distance);
    const bool free = std::none_of(chosen.begin(), chosen.end(), [&](std::uint32_t other) {
      const Vec3 d = feet[other].at - foot.at;
      return dot(d, d) < spacing * spacing;
    });
    if (free) chosen.push_back(c.foot);
    if (chosen.size() > HermiteRbf::kMaxCenters) break;
  }
  return chosen;
}

// Hole with its smooth function.
struct Fill {
  Hole hole;
  std::optional<HermiteRbf> smooth;
  bool wanted = false;
};

// Returns the blocks of the rims and their neighbours.
std::vector<std::uint32_t> blocks_around(const BlockGrid& grid, const std::vector<Fill>& fills) {
  std::vector<char> near(grid.n_blocks(), 0);
  for (const Fill& fill : fills) {
    for (const NodeId& id : fill.hole.rim) {
      for (const std::int32_t b : grid.neighbours[id.block]) {
        if (b != kNoBlock) near[b] = 1;
      }
    }
  }
  std::vector<std::uint32_t> blocks;
  for (std::uint32_t b = 0; b < grid.n_blocks(); ++b) {
    if (near[b]) blocks.push_back(b);
  }
  return blocks;
}

// Returns the measured nodes in these blocks.
std::vector<NodeId> nodes_around(const BlockGrid& grid, const std::vector<Fill>& fills) {
  std::vector<NodeId> nodes;
  for (const std::uint32_t b : blocks_around(grid, fills)) {
    for (std::uint16_t n = 0; n < BlockGrid::kNodes; ++n) {
      if (std::isfinite(grid.block_values(b)[n]) && !grid.is_filled(b, n)) nodes.push_back({b, n});
    }
  }
  return nodes;
}

// Returns the value of a measured node, and NaN for other nodes.
float measured(const BlockGrid& grid, const NodeId& id, int dx, int dy, int dz) {
  NodeId at;
  if (!step_to(grid, id, dx, dy, dz, at) || grid.is_filled(at.block, at.node)) {
    return BlockGrid::kUnknown;
  }
  return grid.block_values(at.block)[at.node];
}

// Returns the gradient by central differences; not finite if one of the six nodes around
// is not measured. One-sided differences would tilt all normals of a rim the same way.
Vec3 gradient_at(const BlockGrid& grid, const NodeId& id) {
  const auto slope = [&](int dx, int dy, int dz) {
    return (measured(grid, id, dx, dy, dz) - measured(grid, id, -dx, -dy, -dz)) / (2 * grid.step);
  };
  return {slope(1, 0, 0), slope(0, 1, 0), slope(0, 0, 1)};
}

// Adds feet on the grid's surface up to the end of the data, beyond the feet of caps.
void add_feet_of_grid(const BlockGrid& grid, const std::vector<Fill>& fills,
                      const NodeSupport& support_of, std::vector<FootPoint>& feet) {
  std::vector<FootPoint> found;
  std::vector<Vec3> around;  // seven for each foot
  for (const NodeId& id : nodes_around(grid, fills)) {
    const float value = grid.block_values(id.block)[id.node];
    if (std::abs(value) >= grid.step) continue;
    const Vec3 gradient = gradient_at(grid, id);
    const double steepness = norm(gradient);
    if (!(steepness > kLeastSteep && steepness < kMostSteep)) continue;
    const Vec3 x = grid.node(id.block, id.node);
    const Vec3 normal = gradient / steepness;
    found.push_back({x - value * normal, normal, 0});
    for (const Vec3& d : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      around.push_back(x + grid.step * d);
      if (norm(d) > 0) around.push_back(x - grid.step * d);
    }
  }
  std::vector<double> support(around.size());
  if (!around.empty()) support_of(around, support);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto seven = support.begin() + static_cast<std::ptrdiff_t>(7 * i);
    if (*std::min_element(seven, seven + 7) >= 1) feet.push_back(found[i]);
  }
}

void make_smooth(const BlockGrid& grid, std::span<const FootPoint> feet,
                 const FeetOfBlocks& feet_of, Fill& fill) {
  const Hole& hole = fill.hole;
  if (!fill.wanted) return;
  const std::vector<Candidate> candidates = candidates_of(grid, hole, feet, feet_of);
  double widen = 1;
  std::vector<std::uint32_t> chosen = thin_out(candidates, hole.radius, feet, widen);
  while (chosen.size() > HermiteRbf::kMaxCenters) {
    widen *= kThinning;
    chosen = thin_out(candidates, hole.radius, feet, widen);
  }
  if (chosen.size() < kLeastCenters) return;
  std::vector<Vec3> centers;
  std::vector<Vec3> normals;
  for (const std::uint32_t f : chosen) {
    centers.push_back(feet[f].at);
    normals.push_back(feet[f].normal);
  }
  HermiteRbf smooth(centers, normals);
  if (smooth.valid()) fill.smooth.emplace(std::move(smooth));
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Returns the smooth function, faded to the winding number far away and bounded by it.
double fill_value(const Fill& fill, const Vec3& x, double winding, double step) {
  const double by_winding = winding_value(winding, step);
  const double away = norm(x - fill.hole.center) / fill.hole.reach;
  const double share = 1 - smooth_step((away - kFadeFrom) / (kFadeTo - kFadeFrom));
  if (share == 0) return by_winding;
  // Far from its centres the function is steep or flat; divided by its slope it is a distance.
  const HermiteRbf::Value smooth = fill.smooth->at(x);
  const double distance = smooth.value / std::max(norm(smooth.gradient), kLeastSlope);
  const double s = std::clamp(distance, -kLargestSteps * step, kLargestSteps * step);
  // The sign must not contradict a clear winding number. Each bound crosses zero
  // where the number becomes clear, so the surface is as smooth there as the number.
  const double outside = kBoundSlope * winding_value(winding + kSure, step);
  const double inside = kBoundSlope * winding_value(winding - kSure, step);
  const double bounded = std::min(std::max(s, outside), inside);
  return share * bounded + (1 - share) * by_winding;
}

// Returns the fill with the hole nearest to x relative to its reach, nullptr if all are far.
const Fill* fill_at(const std::vector<Fill>& fills, const Vec3& x) {
  const Fill* nearest = nullptr;
  double least = kFadeTo;
  for (const Fill& fill : fills) {
    const double away = norm(x - fill.hole.center) / fill.hole.reach;
    if (away >= least) continue;
    least = away;
    nearest = &fill;
  }
  return nearest;
}

NodeValues smooth_values(const std::vector<Fill>& fills, const WindingNumbers& winding, double step,
                         const Context& context) {
  return [&fills, winding, step, context](std::span<const Vec3> x, std::span<double> values) {
    const std::vector<double> w = winding(x, kWindingOpening);
    parallel_for(x.size(), 64, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Fill* const fill = fill_at(fills, x[i]);
        values[i] = fill ? fill_value(*fill, x[i], w[i], step) : winding_value(w[i], step);
      }
    });
  };
}

// Makes values positive where seen space is empty, like a winding number clearly outside.
NodeValues carved(NodeValues values, const SeenSpace* seen, double step) {
  if (seen == nullptr) return values;
  return [values = std::move(values), seen, step](std::span<const Vec3> x, std::span<double> out) {
    values(x, out);
    for (std::size_t i = 0; i < x.size(); ++i) {
      out[i] =
          std::max(out[i], kBoundSlope * winding_value(0.5 + kEmpty - seen->emptiness(x[i]), step));
    }
  };
}

void clear(BlockGrid& grid, const Hole& hole) {
  for (const NodeId& id : hole.nodes) {
    grid.block_values(id.block)[id.node] = BlockGrid::kUnknown;
    grid.filled[8 * std::size_t{id.block} + (id.node >> 6)] &=
        ~(std::uint64_t{1} << (id.node & 63));
  }
}

// Blends values with weak support into the fill. These nodes count as filled from
// now on, since a vertex there lies at the zero of the blend, not on the caps.
void hand_over(BlockGrid& grid, const std::vector<Fill>& fills, const NodeSupport& support_of,
               const NodeValues& values) {
  const std::vector<NodeId> nodes = nodes_around(grid, fills);
  std::vector<Vec3> x;
  x.reserve(nodes.size());
  for (const NodeId& id : nodes) x.push_back(grid.node(id.block, id.node));
  std::vector<double> support(x.size(), 1);
  if (!x.empty()) support_of(x, support);
  std::vector<std::size_t> weak;
  std::vector<Vec3> weak_x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (support[i] >= 1 || fill_at(fills, x[i]) == nullptr) continue;
    weak.push_back(i);
    weak_x.push_back(x[i]);
  }
  std::vector<double> filled(weak.size());
  if (!weak.empty()) values(weak_x, filled);
  for (std::size_t i = 0; i < weak.size(); ++i) {
    const NodeId& id = nodes[weak[i]];
    const double share = std::max(support[weak[i]], 0.0);
    float& value = grid.block_values(id.block)[id.node];
    value = static_cast<float>(share * value + (1 - share) * filled[i]);
    grid.filled[8 * std::size_t{id.block} + (id.node >> 6)] |= std::uint64_t{1} << (id.node & 63);
  }
}

}  // namespace

// 14 steps are a block's diagonal, and supports of caps are shorter: 28 steps cover both.
double reach_of_feet(const Hole& hole, double step) {
  return hole.reach + kBorder * hole.radius + 28 * step;
}

HoleFilling fill_holes(BlockGrid& grid, const FeetNear& feet, const WindingNumbers& winding,
                       const HoleFillOptions& options, const Context& context) {
  HoleFilling result;
  GridPart part = options.part != nullptr ? *options.part : GridPart{};
  const GridPart* const whole_or_part = options.part != nullptr ? &part : nullptr;
  const auto close = [&](const NodeValues& values) {
    const Closing closing = close_grid(grid, values, options.max_blocks, context, whole_or_part);
    part.open = closing.seen;
    return closing.filled_nodes;
  };
  result.filled_nodes = close(carved(winding_values(winding, grid.step), options.seen, grid.step));
  if (result.filled_nodes == 0) return result;
  std::vector<Hole> holes = find_holes(grid);
  std::vector<FootPoint> all_feet = feet(holes);
  std::vector<Fill> fills;
  fills.reserve(holes.size());
  for (Hole& hole : holes) fills.push_back({std::move(hole), {}, false});
  if (options.part != nullptr) part.complete(grid, blocks_around(grid, fills));
  for (Fill& fill : fills) {
    fill.wanted = is_large(fill.hole, grid.step) || may_bridge(grid, fill.hole);
  }
  result.holes = fills.size();
  if (options.support) {
    std::erase_if(fills, [&](const Fill& fill) { return !fill.wanted; });
    add_feet_of_grid(grid, fills, options.support, all_feet);
  }
  const FeetOfBlocks feet_of = sort_feet(grid, all_feet);
  parallel_for(fills.size(), 1, context, {}, [&](std::size_t begin, std::size_t) {
    make_smooth(grid, all_feet, feet_of, fills[begin]);
  });
  std::erase_if(fills, [](const Fill& fill) { return !fill.smooth; });
  result.smooth = fills.size();
  if (fills.empty()) return result;
  const NodeValues values =
      carved(smooth_values(fills, winding, grid.step, context), options.seen, grid.step);
  for (const Fill& fill : fills) {
    clear(grid, fill.hole);
    result.filled_nodes -= fill.hole.nodes.size();
  }
  if (options.support) hand_over(grid, fills, options.support, values);
  result.filled_nodes += close(values);
  return result;
}

}  // namespace rholm
