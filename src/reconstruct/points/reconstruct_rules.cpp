#include "reconstruct/points/reconstruct_rules.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rholm/error.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {
namespace {

// Share of points far from all others that makes outliers near the surface likely. Without far
// points and wrong normals there are no outliers near it either, and points that no cap fits are at
// an edge. A box of random outliers has several times as many far points.
constexpr double kSuspicious = 1e-3;
// Share of wrong normals with the same effect. Outliers may be more than the wrong normals by this
// factor: some agree by chance, or the normals around them contradict each other.
constexpr double kSuspiciousNormals = 0.01, kMoreWrong = 2;
constexpr double kLeastGroup = 0.002;  // of the points
// Length of the mean normal from which nothing is enclosed: of a cap of a sphere of 37 degrees.
constexpr double kFlat = 0.9;
// Diagonals: squares of distances between neighbours must stay within single precision.
constexpr double kSmallest = 1e-12, kLargest = 1e12;

}  // namespace

bool are_suspicious(double n, double isolated, double wrong) {
  return isolated > kSuspicious * n || wrong > kSuspiciousNormals * n;
}

std::size_t most_outliers(double isolated, double wrong) {
  return static_cast<std::size_t>(isolated + kMoreWrong * wrong);
}

std::size_t least_group(std::size_t n) {
  return std::max(kFewestPoints, static_cast<std::size_t>(kLeastGroup * static_cast<double>(n)));
}

void check_spread(std::size_t n, double diagonal) {
  if (n < kFewestPoints) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} different {} too few for a surface: {} at least", n,
                            n == 1 ? "point is" : "points are", kFewestPoints));
  }
  if (!(diagonal > kSmallest && diagonal < kLargest)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the points span {}: {} ... {} can be worked with; take another unit",
                            diagonal, kSmallest, kLargest));
  }
}

void refuse_one_line(std::size_t n) {
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("all {} points lie on one line, within {:.0e} of its length: give "
                          "points of a surface",
                          n, kLine));
}

void check_sides(const SideBalance& balance, std::size_t n) {
  if (!(balance.one_sided > kFlat)) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("these {} points bound no solid: their normals all point to one side, as "
                          "of a plane; holes 'keep' makes an open sheet",
                          n));
}

void check_shape(const LocalShape& shape, std::size_t n) {
  if (shape.kind == LocalKind::kCurve) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("these {} points lie on a curve, not on a surface: their neighbourhoods "
                    "are lines; give points of a surface, or more of them between the lines",
                    n));
  }
  if (shape.kind == LocalKind::kVolume) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("these {} points fill a volume, and lie on no surface: their flattest "
                            "neighbourhoods, of {} points, are {:.2f} times as thick as wide; give "
                            "points of the surface, or remove most of the noise",
                            n, shape.neighbors, shape.thickness));
  }
}

void note_crossings(const Crossings& crossings, double diagonal, ReconstructReport& report) {
  report.crossing_length = crossings.length / diagonal;
  report.crossings.assign(crossings.at.begin(),
                          crossings.at.begin() + static_cast<std::ptrdiff_t>(crossings.named()));
}

void note_walls(const WallCheck& walls, ReconstructReport& report) {
  report.points_off_surface = walls.share();
  const std::size_t named = std::min(walls.off, kNamedWalls);
  report.places_off_surface.assign(walls.at.begin(),
                                   walls.at.begin() + static_cast<std::ptrdiff_t>(named));
}

std::size_t area_neighbors(std::size_t flat) { return flat > 2 * kCircle ? flat : kCircle; }

SurfaceRules kept_rules(const ReconstructOptions& options) {
  SurfaceRules rules;
  rules.holes = options.holes;
  rules.min_component = options.min_component;
  rules.simplify = options.simplify;
  return rules;
}

std::vector<std::string> carried_names(const std::vector<Attribute>& attributes) {
  std::vector<std::string> names;
  names.reserve(attributes.size());
  for (const Attribute& attribute : attributes) {
    const std::string& name = attribute.name;
    if (name != "nx" && name != "ny" && name != "nz") names.push_back(name);
  }
  return names;
}

CoverOptions cover_options(const ReconstructOptions& options, const CapSize& size) {
  return {.neighbours = size.neighbours,
          .degree = kDegree,
          .noise = size.noise,
          .gradient_weight = size.gradient_weight,
          .tolerance = options.tolerance};
}

bool is_even(const CapSize& size, const ReconstructOptions& options) {
  return size.noise == 0 && options.tolerance == 0;
}

double choose_step(double fine_spacing, double wanted, bool even) {
  return std::max(kStepOfSpacing * fine_spacing, (even ? kStepOfError : kStepOfSupport) * wanted);
}

}  // namespace rholm
