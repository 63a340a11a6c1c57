#include "transform/error/radial_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "harmonic/fft/fft.h"
#include "rholm/grid.h"
#include "shape/face.h"
#include "transform/error/corner_bounds.h"
#include "transform/error/long_faces.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Each round divides the cells whose bounds are above this part of the highest bound. Chosen:
// halving an edge leaves a quarter to a half of the difference between bound and error.
constexpr double kDivided = 0.5;
// An edge shorter than this part of the longest is not halved (chosen).
constexpr double kSliver = 0.5;
// Number of faces in a run, and number of runs that
// a thread takes at a time (chosen: some 100 us).
constexpr std::size_t kRun = 128, kGrain = 64;

// Degrees up to this one are bounded on a grid (chosen: 16 MB).
constexpr int kMostOnGrid = 512;

// A part of a face, relative to the centre and times the scale.
struct Cell {
  std::array<Vec3, 3> corners;
  std::size_t face = 0;
  double bound = 0;       // bound on the error in the cell
  bool measured = false;  // true if the bound uses the error in the middle of the cell
};

// Returns a bound on second derivatives of r = d/c of a plane along great circles. c is the least
// cosine between directions and the plane's normal: r'' <= r (2/c^2 - 1).
double plane_bend(double d, double c) { return c > 0 ? d / c * (2 / (c * c) - 1) : kInfinity; }

struct Plane {
  Vec3 normal;
  double distance = 0;  // 0 where no bound holds
};
Plane plane_of(const std::array<Vec3, 3>& p) {
  const FaceNormal normal = face_normal(p);
  if (normal.degenerate) return {};
  const Vec3 n = normalized(normal.twice_area);
  return {n, dot(n, p[0])};
}

// Divides a cell into halves of its longest edge, or into quarters.
void divide(const Cell& cell, std::vector<Cell>& parts) {
  const auto& p = cell.corners;
  std::array<double, 3> edges;
  for (int i = 0; i < 3; ++i) edges[i] = norm(p[(i + 1) % 3] - p[i]);
  const int i = static_cast<int>(std::ranges::max_element(edges) - edges.begin());
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    parts.push_back({{a, b, c}, cell.face, cell.bound, false});
  };
  const Vec3 &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
  const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  if (std::min(edges[(i + 1) % 3], edges[(i + 2) % 3]) < kSliver * edges[i]) {
    add(a, ab, c);
    add(ab, b, c);
    return;
  }
  add(a, ab, ca);
  add(ab, b, bc);
  add(ca, bc, c);
  add(ab, bc, ca);
}

bool worse(const Cell& a, const Cell& b) {
  return a.bound != b.bound ? a.bound > b.bound : a.face < b.face;
}

// Uses that the terms of degree l are at most sqrt((2l + 1)/4 pi) times their norm.
double by_energies(const std::vector<double>& energies, int first, int last) {
  double sum = 0;
  for (int l = first; l <= last; ++l) {
    const double energy = energies[static_cast<std::size_t>(l)];
    sum += 1.0 * l * l * std::sqrt((2 * l + 1) / (4 * std::numbers::pi) * energy);
  }
  return sum;
}

// A trigonometric polynomial of degree L is at most its largest value at N equidistant points,
// divided by cos(pi L / N). This holds once along circles of latitude, once along meridians.
double on_grid(const Coefficients& coefficients, int first, int last, const Context& context) {
  Coefficients terms = coefficients.resized(last);
  for (int l = 0; l < first; ++l) {
    for (int m = 0; m <= l; ++m) terms.c(l, m) = terms.s(l, m) = 0;
  }
  const int n = static_cast<int>(smooth_length(static_cast<std::size_t>(4 * last), 2));
  const Grid grid{.kind = GridKind::kEquiangular, .n_theta = n / 2, .n_phi = n};
  double highest = 0;
  for (const double value : synthesize_grid(terms, grid, context)) {
    highest = std::max(highest, std::abs(value));
  }
  const double fall = std::cos(std::numbers::pi * last / grid.n_phi);
  return 1.0 * last * last * highest / (fall * fall);
}

class Search {
 public:
  Search(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
         const RadialModel& model, const BoundOptions& options, const Context& context)
      : mesh_(mesh),
        center_(expansion.center),
        scale_(scan.sizes.scale),
        model_(model),
        context_(context),
        seen_(scale_ * options.seen),
        enough_(scale_ * options.enough),
        uncertainty_(scale_ * options.uncertainty),
        most_cells_(options.most_cells),
        bend_(scale_ * second_derivative_bound(expansion.coefficients, context)) {}

  RadialBound run() {
    open_faces();
    while (!open_.empty() && cells_ < most_cells_) measure(parts_of_worst());
    double highest = enough_;
    for (const Cell& cell : open_) highest = std::max(highest, cell.bound);
    return {highest / scale_, cells_};
  }

 private:
  // Opens the faces that may have errors beyond the errors at their corners. If these are more than
  // half of the cells, runs with the lowest bounds stay closed; other bounds need not be lower.
  void open_faces() {
    struct Run {
      double highest = 0;
      std::size_t number = 0, open = 0;
    };
    std::vector<Run> runs((mesh_.n_faces + kRun - 1) / kRun);
    const auto bounds_of = [&](std::size_t run, std::array<double, kRun>& bounds) {
      const std::size_t begin = run * kRun, end = std::min(mesh_.n_faces, begin + kRun);
      corner_bounds(mesh_, begin, end, center_, scale_, bend_, bounds.data());
      for (std::size_t i = 0; i < end - begin; ++i) bounds[i] += seen_ + uncertainty_;
      return std::span(bounds).first(end - begin);
    };
    parallel_for(runs.size(), kGrain, context_, {}, [&](std::size_t begin, std::size_t end) {
      std::array<double, kRun> room;
      for (std::size_t r = begin; r < end; ++r) {
        runs[r].number = r;
        for (const double bound : bounds_of(r, room)) {
          runs[r].highest = std::max(runs[r].highest, bound);
          runs[r].open += bound > enough_;
        }
      }
    });
    std::erase_if(runs, [](const Run& run) { return run.open == 0; });
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
      return a.highest != b.highest ? a.highest > b.highest : a.number < b.number;
    });
    std::size_t faces = 0, opened = 0;
    while (opened < runs.size() && faces + runs[opened].open <= most_cells_ / 2) {
      faces += runs[opened++].open;
    }
    if (opened < runs.size()) enough_ = runs[opened].highest;
    open_.reserve(faces);
    std::array<double, kRun> room;
    for (std::size_t k = 0; k < opened; ++k) {
      const std::span<const double> bounds = bounds_of(runs[k].number, room);
      for (std::size_t i = 0; i < bounds.size(); ++i) {
        if (!(bounds[i] > enough_)) continue;
        const std::size_t face = runs[k].number * kRun + i;
        open_.push_back({corners(face), face, bounds[i]});
      }
    }
  }

  // Takes the open cells with the highest bounds. Returns their parts, or the cells themselves if
  // they are not measured yet.
  std::vector<Cell> parts_of_worst() {
    double highest = 0;
    for (const Cell& cell : open_) highest = std::max(highest, cell.bound);
    const auto rest = std::partition(open_.begin(), open_.end(), [&](const Cell& cell) {
      return !(cell.bound < kDivided * highest);
    });
    auto last = rest;
    const std::size_t most = (most_cells_ - cells_ + 3) / 4;
    if (rest - open_.begin() > static_cast<std::ptrdiff_t>(most)) {
      last = open_.begin() + static_cast<std::ptrdiff_t>(most);
      std::nth_element(open_.begin(), last, rest, worse);
    }
    std::vector<Cell> parts;
    parts.reserve(4 * static_cast<std::size_t>(last - open_.begin()));
    for (auto cell = open_.begin(); cell != last; ++cell) {
      if (cell->measured) {
        divide(*cell, parts);
      } else {
        parts.push_back(*cell);
      }
    }
    open_.erase(open_.begin(), last);
    return parts;
  }

  // Measures cells, and opens the cells that may have an error above `enough_`.
  void measure(std::vector<Cell> cells) {
    std::vector<Vec3> directions(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto& [a, b, c] = cells[i].corners;
      directions[i] = normalized(normalized(a) + normalized(b) + normalized(c));
    }
    const ValuesAndGradients model = model_.sums.at(directions, true, context_);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Cell& cell = cells[i];
      cell.bound = std::min(cell.bound, bound_of(cell, directions[i], scale_ * model.values[i],
                                                 scale_ * model.gradients[i]));
      cell.measured = true;
      if (!(cell.bound <= enough_)) open_.push_back(cell);
    }
    cells_ += cells.size();
  }

  // Let e = r - r_L, and M bound second derivatives along great circles. Within an angle h of a
  // direction u on one face,
  //   |e| <= |e(u)| + h |grad e(u)| + h^2/2 (M_r + M_L).
  double bound_of(const Cell& cell, const Vec3& u, double value, const Vec3& gradient) const {
    const Plane plane = plane_of(corners(cell.face));
    double h = 0;  // radius of a cap around u that contains the cell
    for (const Vec3& x : cell.corners) h = std::max(h, std::atan2(norm(cross(u, x)), dot(u, x)));
    const double cosine = dot(plane.normal, u);
    const double least = std::cos(std::acos(std::clamp(cosine, -1.0, 1.0)) + h);
    if (!(plane.distance > 0 && cosine > 0 && least > 0 && h < 1)) return kInfinity;
    const double r = plane.distance / cosine;
    const Vec3 slope = -r / cosine * (plane.normal - cosine * u) - gradient;
    return std::abs(r - value) + uncertainty_ + h * norm(slope) +
           h * h / 2 * (plane_bend(plane.distance, least) + bend_);
  }

  std::array<Vec3, 3> corners(std::size_t t) const {
    return corners_of(mesh_, mesh_.triangle(t), center_, scale_);
  }

  const MeshView& mesh_;
  Vec3 center_;
  double scale_;
  const RadialModel& model_;
  const Context& context_;
  double seen_, enough_, uncertainty_;  // times the scale, like the bounds of cells
  std::size_t most_cells_;
  double bend_;
  std::vector<Cell> open_;
  std::size_t cells_ = 0;
};

}  // namespace

double second_derivative_bound(const Coefficients& coefficients, const Context& context) {
  const std::vector<double> energies = power_spectrum(coefficients);
  double sum = 0;
  for (int last = coefficients.degree(); last > 0;) {
    const int first = std::min(last, static_cast<int>(last / std::numbers::sqrt2) + 1);
    double bound = by_energies(energies, first, last);
    if (last <= kMostOnGrid) bound = std::min(bound, on_grid(coefficients, first, last, context));
    sum += bound;
    last = first - 1;
  }
  return sum;
}

RadialBound radial_bound(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         const RadialModel& model, const BoundOptions& options,
                         const Context& context) {
  return Search(mesh, scan, expansion, model, options, context).run();
}

}  // namespace rholm
