#include "shape/points/normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "shape/points/plane_fit.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain = 1024;  // number of points of a chunk; chosen: a few milliseconds

// Numbers of neighbours to choose from, measured on clean samples of meshes. Below 10 the error
// grows, as 6 unknowns need more points; every factor 1.5 changes the error by 10 %.
constexpr int kLadder[] = {10,  15,  22,  33,   50,   75,   112,  168, 252,
                           378, 567, 850, 1275, 1913, 2870, 4305, 6458};
constexpr std::size_t kRungs = std::size(kLadder);
// Rungs that are always tried. The others are for noise of more than a spacing: only where the last
// of the first ones is best, since they take a second.
constexpr std::size_t kFirstRungs = 9;
constexpr double kCleanFall = 3.3;    // see choose_neighbors
constexpr double kCalmShare = 0.9;    // see choose_neighbors
constexpr std::size_t kSeeds = 1000;  // chosen: the error of the mean is 3 %
constexpr std::size_t kSeedsOfMore = 400;

// Points within this part of the radius of a fit to many neighbours share it. Chosen: there, terms
// of third order are 1/64 of those at the radius.
constexpr double kShared = 0.25;

// Neighbours ten times as long as wide (squares in PlaneFit) are nearly on a line, such as a
// scanner's. Then twice as many are asked for each time, up to kMostNeighbors (chosen: a
// millisecond for ten points).
constexpr double kLine = 0.01;
constexpr std::size_t kMostNeighbors = 640;
// Below this ratio there is no plane: the width is rounding.
constexpr double kNoPlane = 1e-10;

struct FitOfPoint {
  Vec3 normal;
  double radius = 0;
  double residual = 0;
  ParaboloidFit shape;  // in units of the neighbourhood's radius, if a paraboloid was fitted
};

double rms_distance(const Neighborhood& near, const Vec3& normal) {
  double sum = 0, total = 0;
  for (std::size_t j = 0; j < near.points.size(); ++j) {
    const double d = dot(near.points[j], normal);
    sum += near.weights[j] * d * d;
    total += near.weights[j];
  }
  return std::sqrt(sum / total);
}

FitOfPoint fit_point(const PointTree& tree, std::span<const Vec3> points, std::size_t i,
                     std::size_t k, bool curved, Neighborhood& near) {
  FitOfPoint fit;
  PlaneFit plane;
  for (std::size_t asked = k; asked == k || asked <= kMostNeighbors; asked *= 2) {
    near.gather(tree, points, i, asked);
    if (!(near.radius > 0)) continue;
    if (fit.radius == 0) fit.radius = near.radius;
    plane = fit_plane(near.points, near.weights);
    if (plane.width >= kLine * plane.length || near.found.size() == points.size()) break;
  }
  if (plane.width <= kNoPlane * plane.length) return fit;
  fit.residual = rms_distance(near, plane.normal);
  if (curved) fit.shape = fit_paraboloid(near.points, near.weights, plane.normal);
  fit.normal = curved ? fit.shape.normal : plane.normal;
  return fit;
}

// Fills the row of point i. `found` has the nearest points; more are added if they are too few.
void keep_neighbors(const PointTree& tree, std::size_t i, std::size_t stride,
                    std::vector<Neighbor>& found, std::span<std::uint32_t> rows) {
  const std::size_t reach = stride * kGraphNeighbors + 1;
  if (found.size() < reach) tree.nearest_to(i, reach, found);
  keep_graph_neighbors(i, stride, found, rows);
}

// Normals of fits at one seed, to the odd and the even halves of its k neighbours.
struct Halves {
  Vec3 odd[kRungs], even[kRungs];
};

Vec3 normal_of_half(const Neighborhood& near, std::size_t first, std::size_t k) {
  Vec3 points[kLadder[kRungs - 1] / 2 + 1];
  double weights[kLadder[kRungs - 1] / 2 + 1];
  const double last2 = near.found[k].distance2;
  std::size_t n = 0;
  for (std::size_t j = first; j <= k; j += 2, ++n) {
    points[n] = near.points[j];
    const double t = 1.15 - (last2 > 0 ? near.found[j].distance2 / last2 : 0);
    weights[n] = t * t;
  }
  return fit_plane({points, n}, {weights, n}).normal;
}

double sine2(const Vec3& a, const Vec3& b) {
  const Vec3 c = cross(a, b);
  return dot(c, c);
}

}  // namespace

void Neighborhood::gather(const PointTree& tree, std::span<const Vec3> all, std::size_t i,
                          std::size_t k, std::size_t stride) {
  tree.nearest_to(i, stride * k + 1, found);
  if (stride > 1) {
    std::size_t kept = 1;
    for (std::size_t j = stride; j < found.size(); j += stride) found[kept++] = found[j];
    found.resize(std::min(kept, found.size()));
  }
  points.resize(found.size());
  weights.resize(found.size());
  double largest2 = 0;
  for (std::size_t j = 0; j < found.size(); ++j) {
    points[j] = all[found[j].index] - all[i];
    weights[j] = dot(points[j], points[j]);
    largest2 = std::max(largest2, weights[j]);
  }
  radius = std::sqrt(largest2);
  if (!(radius > 0)) return;
  for (std::size_t j = 0; j < found.size(); ++j) {
    points[j] = points[j] / radius;
    const double t = 1.15 - weights[j] / largest2;  // (method 7.8)
    weights[j] = t * t;
  }
}

namespace {

// Returns the place in kLadder of the best of the first `rungs` numbers.
std::size_t best_rung(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                      std::size_t rungs, std::size_t n_seeds, const Context& context) {
  const std::size_t n = points.size();
  const std::size_t most_stride = n / static_cast<std::size_t>(kLadder[rungs - 1] + 2);
  std::vector<Halves> halves(n_seeds);
  parallel_for(n_seeds, 16, context, {}, [&](std::size_t begin, std::size_t end) {
    Neighborhood near;
    for (std::size_t s = begin; s < end; ++s) {
      const std::size_t i = s * n / n_seeds;
      near.gather(tree, points, i, kLadder[rungs - 1], std::min(gaps.stride(i), most_stride));
      for (std::size_t r = 0; r < rungs; ++r) {
        halves[s].odd[r] = normal_of_half(near, 1, kLadder[r]);
        halves[s].even[r] = normal_of_half(near, 2, kLadder[r]);
      }
    }
  });
  // Mean of sin^2 between half fits of rungs a and b. For a = b the bias cancels, and twice the
  // variance of a half remains, four times the variance of the whole.
  const auto difference = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (const Halves& h : halves) sum += sine2(h.odd[a], h.even[b]) + sine2(h.even[a], h.odd[b]);
    return sum / static_cast<double>(2 * n_seeds);
  };
  // Computes difference(r, r) without its largest tenth. The points of a half may
  // lie nearly on a line, where the plane is arbitrary. Measured: a few such seeds
  // would be half of the mean.
  const auto calm_difference = [&](std::size_t r) {
    std::vector<double> each(n_seeds);
    for (std::size_t s = 0; s < n_seeds; ++s) each[s] = sine2(halves[s].odd[r], halves[s].even[r]);
    std::sort(each.begin(), each.end());
    const auto calm = static_cast<std::size_t>(kCalmShare * static_cast<double>(n_seeds));
    return std::accumulate(each.begin(), each.begin() + static_cast<std::ptrdiff_t>(calm), 0.0);
  };
  // A random direction has a mean sin^2 of 2/3. The base is the first rung well below this value
  // (chosen: a deviation of 25 degrees).
  std::size_t base = 0;
  while (base + 1 < rungs && difference(base, base) > 0.18) ++base;
  // Noise makes half fits differ by a variance that falls as 1 / k^2; for curvature and edges it
  // falls more slowly. Measured (scripts/constants) from 10 to 22 neighbours, the fall is 4.8 or
  // more for noise alone. Clean samples of meshes have 0.7 (flat faces) to 3. Noise of a
  // twentieth of the spacing gives 3.4 or more, and 3.1 on the most detailed mesh. Clean points
  // get the smallest neighbourhood.
  if (base == 0 && calm_difference(0) < kCleanFall * calm_difference(2)) return 0;
  std::size_t best = base;
  double least = 1;
  for (std::size_t r = base; r < rungs; ++r) {
    const double own = difference(r, r);
    const double bias2 = std::max(0.0, difference(base, r) - 0.5 * (difference(base, base) + own));
    const double error2 = own / 4 + bias2;
    if (error2 < least) {
      least = error2;
      best = r;
    }
  }
  return best;
}

}  // namespace

int choose_neighbors(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                     const Context& context) {
  const std::size_t n = points.size(), stride = gaps.typical_stride();
  std::size_t rungs = 0;  // number of rungs with at most a tenth of the points
  while (rungs < kRungs && stride * static_cast<std::size_t>(kLadder[rungs]) * 10 <= n) ++rungs;
  if (rungs < 3) return kLadder[0];
  const std::size_t first = std::min(rungs, kFirstRungs);
  std::size_t best = best_rung(tree, points, gaps, first, std::min(n, kSeeds), context);
  if (best + 1 == kFirstRungs && rungs > kFirstRungs) {
    best = best_rung(tree, points, gaps, rungs, std::min(n, kSeedsOfMore), context);
  }
  return kLadder[best];
}

namespace {

// Returns the radius of the disc that has as many points per area as the ball of a fit has in its
// middle, over the ball's radius. Noise leads out of the ball near its rim.
double disc_of_ball(const Neighborhood& near, const Vec3& normal) {
  constexpr double kMiddle = 0.5;  // radius of the cylinder whose points are counted
  std::size_t within = 0;
  for (const Vec3& p : near.points) {
    const double h = dot(p, normal);
    within += dot(p, p) - h * h < kMiddle * kMiddle;
  }
  const auto all = static_cast<double>(near.points.size());
  return kMiddle * std::sqrt(all / static_cast<double>(std::max<std::size_t>(within, 1)));
}

// Fits the points of a chunk of the tree's order. Some of them share their fits with points near
// them in the same chunk.
class ChunkFit {
 public:
  ChunkFit(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
           std::span<const std::uint8_t> skipped, LocalFits& fits)
      : tree_(tree), points_(points), gaps_(gaps), skipped_(skipped), fits_(fits) {}

  void fit(std::size_t begin, std::size_t end) {
    const bool shared = fits_.n_neighbors > kMostForOwnFits;
    const bool curved = shared || fits_.n_neighbors <= kMostForCurvature;
    begin_ = begin;
    fitted_.assign(end - begin, 0);
    for (std::size_t i = begin; i < end; ++i) {
      if (!skipped_.empty() && skipped_[i] != 0) continue;
      if (fitted_[i - begin] != 0) {
        tree_.nearest_to(i, gaps_.stride(i) * kGraphNeighbors + 1, near_.found);
      } else {
        const std::size_t k = gaps_.scaled(i, static_cast<std::size_t>(fits_.n_neighbors));
        FitOfPoint fit = fit_point(tree_, points_, i, k, curved, near_);
        if (shared && !(fit.normal == Vec3{})) fit.radius *= disc_of_ball(near_, fit.shape.plane);
        put(i, fit, fit.normal);
        if (shared) share(i, fit);
      }
      keep_neighbors(tree_, i, gaps_.stride(i), near_.found, fits_.neighbors);
    }
  }

 private:
  void put(std::size_t i, const FitOfPoint& fit, const Vec3& normal) {
    fits_.normals[i] = normal;
    fits_.radius[i] = static_cast<float>(fit.radius);
    fits_.residual[i] = static_cast<float>(fit.residual);
    fitted_[i - begin_] = 1;
  }
  // Stores the fit of point i for those near it, too.
  void share(std::size_t i, const FitOfPoint& fit) {
    fits_.settled[i] = points_[i];
    if (fit.normal == Vec3{}) return;
    const Vec3 middle = points_[i];
    fits_.settled[i] += near_.radius * fit.shape.point_at({});
    for (std::size_t j = 0; j < near_.found.size(); ++j) {
      const std::size_t other = near_.found[j].index;
      if (dot(near_.points[j], near_.points[j]) > kShared * kShared) return;
      if (other < begin_ || other - begin_ >= fitted_.size()) continue;
      if (fitted_[other - begin_] != 0 || (!skipped_.empty() && skipped_[other] != 0)) continue;
      put(other, fit, fit.shape.normal_at(near_.points[j]));
      fits_.settled[other] = middle + near_.radius * fit.shape.point_at(near_.points[j]);
    }
  }

  const PointTree& tree_;
  std::span<const Vec3> points_;
  const SamplingGaps& gaps_;
  std::span<const std::uint8_t> skipped_;
  LocalFits& fits_;
  std::size_t begin_ = 0;
  std::vector<std::uint8_t> fitted_;
  Neighborhood near_;
};

}  // namespace

bool are_noisy(int n_neighbors) { return n_neighbors > kLadder[0]; }

void keep_graph_neighbors(std::size_t i, std::size_t stride, std::span<const Neighbor> found,
                          std::span<std::uint32_t> rows) {
  const std::size_t last = std::min(stride * kGraphNeighbors + 1, found.size());
  const std::size_t nearest = stride > 1 ? kGraphNeighbors / 2 : kGraphNeighbors;
  std::uint32_t* row = &rows[i * kGraphNeighbors];
  std::size_t n = 0;
  for (std::size_t j = 0; j < last && n < kGraphNeighbors; ++j) {
    const bool taken = n < nearest || (j + stride / 2) % stride == 0;
    if (found[j].index != i && taken) row[n++] = found[j].index;
  }
  std::fill(row + n, row + kGraphNeighbors, static_cast<std::uint32_t>(i));
}

std::vector<std::uint32_t> graph_neighbors(const PointTree& tree, const SamplingGaps& gaps,
                                           const Context& context) {
  std::vector<std::uint32_t> rows(tree.size() * kGraphNeighbors);
  parallel_for(tree.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> found;
    for (std::size_t i = begin; i < end; ++i) {
      found.clear();
      keep_neighbors(tree, i, gaps.stride(i), found, rows);
    }
  });
  return rows;
}

LocalFits fit_normals(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                      std::span<const Vec3> given, int n_neighbors, const Context& context,
                      std::span<const std::uint8_t> skipped) {
  LocalFits fits;
  const std::size_t n = points.size();
  fits.n_neighbors = n_neighbors > 0 ? n_neighbors : choose_neighbors(tree, points, gaps, context);
  fits.noisy = are_noisy(fits.n_neighbors);
  const bool curved = fits.n_neighbors <= kMostForCurvature;
  fits.normals.resize(n);
  fits.radius.resize(n);
  fits.residual.resize(n);
  fits.neighbors.resize(n * kGraphNeighbors);
  if (fits.n_neighbors > kMostForOwnFits) fits.settled.resize(n);
  parallel_for(n, kGrain, context, {.name = "normals", .from = 0, .to = 0.7},
               [&](std::size_t begin, std::size_t end) {
                 ChunkFit(tree, points, gaps, skipped, fits).fit(begin, end);
               });
  std::vector<float> residuals = fits.residual;
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  fits.typical_residual = *middle;
  if (curved) refine_at_edges(tree, points, gaps, fits, context);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (norm(given[i]) > 0) fits.normals[i] = normalized(given[i]);
  }
  return fits;
}

}  // namespace rholm
