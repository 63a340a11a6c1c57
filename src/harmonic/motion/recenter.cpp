// Newton's steps within a bracket find the root rho of F for each direction u. With p = d + rho u
// and the new centre d seen from the old one,
//   F(rho) = |p| - r(p/|p|),    F' = (p . u - grad r . u) / |p|.
#include "rholm/recenter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/grid.h"
#include "rholm/harmonic.h"

namespace rholm {
namespace {

constexpr int kMaxSteps = 100;  // 53 bisections close any bracket
constexpr double kPrecision = 1e-13;

Grid grid_for(int degree, int factor) {
  return smallest_grid(GridKind::kGaussLegendre,
                       std::min(factor * std::max(degree, 1), kMaxDegree));
}

std::vector<Vec3> directions_of(const Grid& grid) {
  std::vector<Vec3> directions;
  directions.reserve(static_cast<std::size_t>(grid.n_theta) * static_cast<std::size_t>(grid.n_phi));
  for (const double theta : grid_colatitudes(grid)) {
    ask_cancel();  // a ring has thousands of points
    for (int k = 0; k < grid.n_phi; ++k) {
      const double phi = 2 * std::numbers::pi * k / grid.n_phi;
      directions.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  return directions;
}

// Replaces the values of the expanded function by radii.
void to_radius(RadialFunction function, std::span<double> values) {
  CancelPoll poll;
  for (double& value : values) {
    poll();
    if (!(value > 0)) {
      throw Error(ErrorCode::kInvalidInput,
                  std::string("the ") + to_string(function) + " is " + std::to_string(value) +
                      " somewhere: the surface has no inside, take fewer degrees or filter it");
    }
    if (function == RadialFunction::kGauge) value = 1 / value;
  }
}

// Finds one root for each direction of a grid.
class Rays {
 public:
  Rays(const Expansion& expansion, const Vec3& to, std::span<const Vec3> directions,
       std::vector<double> first, double highest)
      : expansion_(expansion),
        d_(to),
        directions_(directions),
        rho_(std::move(first)),
        low_(rho_.size(), 0.0),
        high_(rho_.size(), highest),
        open_(rho_.size()) {
    std::iota(open_.begin(), open_.end(), std::size_t{0});
  }

  std::vector<double> solve(const Context& context) {
    const Context quiet{.threads = context.threads, .progress = {}};
    for (int n = 0; n < kMaxSteps && !open_.empty(); ++n) {
      report_progress(context, "recenter", static_cast<double>(n) / kMaxSteps);
      step(quiet);
    }
    return std::move(rho_);
  }

 private:
  void step(const Context& context) {
    std::vector<Vec3> at(open_.size());
    CancelPoll poll;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      poll();
      const Vec3 p = point(open_[k]);
      at[k] = p == Vec3{} ? directions_[open_[k]] : normalized(p);
    }
    ValuesAndGradients f = evaluate_with_gradient(expansion_.coefficients, at, {}, context);
    const bool gauge = expansion_.function == RadialFunction::kGauge;
    to_radius(expansion_.function, f.values);
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      poll();
      const double r = f.values[k];
      const Vec3 slope = gauge ? -r * r * f.gradients[k] : f.gradients[k];
      if (!newton(open_[k], r, slope)) left.push_back(open_[k]);
    }
    open_ = std::move(left);
  }

  // Returns true if the root is found.
  bool newton(std::size_t i, double r, const Vec3& slope) {
    const Vec3 p = point(i), &u = directions_[i];
    const double distance = norm(p);
    const double value = distance - r, rise = (dot(p, u) - dot(slope, u)) / distance;
    (value > 0 ? high_ : low_)[i] = rho_[i];
    const double next = rho_[i] - value / rise;
    const bool inside = rise > 0 && next > low_[i] && next < high_[i];
    const double before = rho_[i];
    rho_[i] = inside ? next : (low_[i] + high_[i]) / 2;
    return std::abs(rho_[i] - before) <= kPrecision * r;
  }

  Vec3 point(std::size_t i) const { return d_ + rho_[i] * directions_[i]; }

  const Expansion& expansion_;
  Vec3 d_;
  std::span<const Vec3> directions_;
  std::vector<double> rho_, low_, high_;
  std::vector<std::size_t> open_;  // rays whose root is not yet found
};

// The surface faces the new centre where two vectors form an acute angle: its outward normal, r u -
// grad r, and r u - d. The condition is r^2 - n . d > 0, linear in d.
struct NewView {
  double way = 1;            // fraction of d at which a quarter of r^2 is left everywhere
  std::vector<Vec3> behind;  // points, seen from d, where the surface faces away from d
};

NewView view_from(const Expansion& expansion, const Vec3& d, std::span<const Vec3> directions,
                  const Context& context) {
  // Chosen: closer to the limit, steeper slopes need higher degrees.
  constexpr double kMargin = 0.25;
  ValuesAndGradients f = evaluate_with_gradient(expansion.coefficients, directions, {}, context);
  to_radius(expansion.function, f.values);
  const bool gauge = expansion.function == RadialFunction::kGauge;
  NewView view;
  CancelPoll poll;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    poll();
    const double r = f.values[i];
    const Vec3& u = directions[i];
    const Vec3 slope = gauge ? -r * r * f.gradients[i] : f.gradients[i];
    const double lost = dot(r * u - slope, d);
    if (lost > (1 - kMargin) * r * r) view.way = std::min(view.way, (1 - kMargin) * r * r / lost);
    if (!(lost < r * r)) view.behind.push_back(r * u - d);
  }
  return view;
}

bool is_inside(const Expansion& expansion, const Vec3& d, const Context& context) {
  if (d == Vec3{}) return true;
  const std::vector<Vec3> direction = {normalized(d)};
  std::vector<double> r = evaluate(expansion.coefficients, direction, {}, context);
  to_radius(expansion.function, r);
  return norm(d) < r[0];
}

// Returns how far ripples of the surface fold back. A ray from d to a point that faces away from d
// also meets the surface elsewhere. The result is the largest distance between the two points,
// relative to the distance of the first point.
double depth_of_folds(const Expansion& expansion, const Vec3& d, const std::vector<Vec3>& behind,
                      double highest, const Context& context) {
  std::vector<Vec3> directions;
  directions.reserve(behind.size());
  for (const Vec3& p : behind) directions.push_back(normalized(p));
  double depth = 0;
  for (const double from : {0.01 * highest, highest}) {
    const std::vector<double> rho =
        Rays(expansion, d, directions, std::vector<double>(behind.size(), from), highest)
            .solve(context);
    for (std::size_t i = 0; i < rho.size(); ++i) {
      depth = std::max(depth, std::abs(rho[i] / norm(behind[i]) - 1));
    }
  }
  return depth;
}

// Folds that are shallower than this are accepted. A truncated series ripples, and may face away
// from a centre that sees the shape (chosen: below what series of degree 16 leave out of cells).
constexpr double kShallow = 0.02;

[[noreturn]] void refuse_hidden(const Vec3& d, const NewView& view) {
  throw Error(ErrorCode::kNotStarShaped,
              "the surface is not star-shaped from the new centre, (" + std::to_string(d.x) + ", " +
                  std::to_string(d.y) + ", " + std::to_string(d.z) +
                  ") from the old one: it turns its back to it in " +
                  std::to_string(view.behind.size()) +
                  " directions of a grid; choose a centre nearer to the old one");
}

// The surface on a grid of twice the degree, and its view from `d`.
struct Sight {
  Grid grid;
  std::vector<Vec3> directions;
  std::vector<double> radii;  // measured from the old centre
  double highest = 0;         // upper limit of the rays from d within the surface
  NewView view;
  bool seen = false;
};

Sight sight_from(const Expansion& expansion, const Vec3& d, const Context& context) {
  Sight sight;
  sight.grid = grid_for(expansion.coefficients.degree(), 2);
  sight.directions = directions_of(sight.grid);
  sight.radii = synthesize_grid(expansion.coefficients, sight.grid, context);
  to_radius(expansion.function, sight.radii);
  sight.highest = 1.1 * *std::max_element(sight.radii.begin(), sight.radii.end()) + norm(d);
  sight.view = view_from(expansion, d, sight.directions, context);
  const std::vector<Vec3>& behind = sight.view.behind;
  sight.seen =
      behind.empty() || (is_inside(expansion, d, context) &&
                         depth_of_folds(expansion, d, behind, sight.highest, context) <= kShallow);
  return sight;
}

Vec3 way_to(const Expansion& expansion, const Vec3& center) {
  require_surface(expansion);
  require_star_shaped(expansion, "what is seen from another centre");
  const Vec3 d = center - expansion.center;
  if (!is_finite(d)) throw Error(ErrorCode::kInvalidInput, "the new centre is not finite");
  return d;
}

}  // namespace

Vec3 volume_centroid(const Expansion& expansion, const Context& context) {
  require_surface(expansion);
  require_star_shaped(expansion, "the centroid");
  // r^4 u has degree 4 L + 1.
  const Grid grid = grid_for(expansion.coefficients.degree(), 3);
  std::vector<double> r = synthesize_grid(expansion.coefficients, grid, context);
  if (expansion.function == RadialFunction::kGauge) to_radius(expansion.function, r);
  double largest = 0;
  for (const double value : r) largest = std::max(largest, std::abs(value));
  const std::vector<Vec3> directions = directions_of(grid);
  const GaussRule rule = gauss_legendre(grid.n_theta);
  CompensatedSum volume, x, y, z;
  CancelPoll poll;
  for (std::size_t i = 0; i < r.size(); ++i) {
    poll();
    const double weight = rule.weights[i / static_cast<std::size_t>(grid.n_phi)];
    const double part = r[i] / largest;
    const double cube = weight * part * part * part;
    volume.add(cube / 3);
    x.add(cube * part / 4 * directions[i].x);
    y.add(cube * part / 4 * directions[i].y);
    z.add(cube * part / 4 * directions[i].z);
  }
  if (!(volume.value() > 0)) {
    throw Error(ErrorCode::kInvalidInput, "the solid has no volume and so no centroid");
  }
  return expansion.center + largest / volume.value() * Vec3{x.value(), y.value(), z.value()};
}

Vec3 seen_center(const Expansion& expansion, const Vec3& wanted, const Context& context) {
  const Vec3 d = way_to(expansion, wanted);
  const Sight sight = sight_from(expansion, d, {.threads = context.threads, .progress = {}});
  return sight.seen ? wanted : expansion.center + sight.view.way * d;
}

Expansion recentered(const Expansion& expansion, const Vec3& center, const Context& context) {
  const Vec3 d = way_to(expansion, center);
  if (d == Vec3{}) return expansion;
  Expansion result;
  result.function = expansion.function;
  result.center = center;
  result.unit = expansion.unit;
  result.method = expansion.method;
  // Radial errors do not carry over: rays differ, and the series is truncated anew.
  if (expansion.errors) result.errors.emplace().diagonal = expansion.errors->diagonal;
  Sight sight = sight_from(expansion, d, {.threads = context.threads, .progress = {}});
  if (!sight.seen) refuse_hidden(d, sight.view);
  std::vector<double> rho =
      Rays(expansion, d, sight.directions, std::move(sight.radii), sight.highest).solve(context);
  if (expansion.function == RadialFunction::kGauge) {
    for (double& value : rho) value = 1 / value;
  }
  result.coefficients = analyze_grid(rho, sight.grid, expansion.coefficients.degree(), context);
  return result;
}

}  // namespace rholm
