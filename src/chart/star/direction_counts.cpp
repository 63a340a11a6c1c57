#include "chart/star/direction_counts.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/parallel.h"
#include "chart/center/view_scan.h"
#include "chart/star/cone.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

// Returns front faces minus back faces that the direction meets, or nothing if it meets an edge.
std::optional<int> surplus_at(const LocalView& view, const Vec3& center, const Vec3& direction,
                              const Context& context) {
  const std::size_t n = view.mesh.n_faces, grain = triangle_grain(n);
  struct Part {
    int surplus = 0;
    bool unclear = false;
  };
  std::vector<Part> parts((n + grain - 1) / grain);
  parallel_for(n, grain, context, {}, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / grain];
    // A direction on the same side of all three sides of a cone meets a front face, or its opposite
    // direction meets a back face.
    scan_lines(view, begin, end, view.frame.to_local(center), direction, [&](std::size_t triangle) {
      const auto corners = corners_from(view, triangle, center);
      const double height = dot(cross(corners[0], corners[1]), corners[2]);
      if (height == 0) return;
      const int side = height > 0 ? 1 : -1;
      const int contains = cone_contains(corners, side * direction);
      part.unclear = part.unclear || contains < 0;
      part.surplus += side * contains;
    });
  });
  int surplus = 0;
  for (const Part& part : parts) {
    if (part.unclear) return std::nullopt;
    surplus += part.surplus;
  }
  return surplus;
}

// Longitude of direction i, as a fraction of a full turn; lattice_z() returns its z.
double lattice_turns(std::size_t i) {
  const double turns = static_cast<double>(i) * (std::numbers::phi - 1);
  return turns - std::floor(turns);
}
double lattice_z(std::size_t i, std::size_t n) {
  return 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(n);
}

// Sorts the directions of the lattice into cells of equal area, to find those near a vector.
class LatticeCells {
 public:
  // `faces`: approximate number of faces that ask for directions near them. If they are few, a
  // direction is computed when it is asked for; otherwise all directions are computed in advance.
  LatticeCells(std::size_t n, std::size_t faces, const Context& context)
      : n_(n),
        rows_(std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(n / kPerCell / 2)))) {
    if (2 * kPerCell * faces > n) directions_.resize(n);
    order_.resize(n);
    first_.resize(2 * rows_ * rows_ + 1);
    std::vector<std::uint32_t> cell(n);
    constexpr std::size_t kGrain = 2048;  // chosen: some 50 us
    parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!directions_.empty()) directions_[i] = lattice_direction(i, n);
        cell[i] =
            static_cast<std::uint32_t>(row(lattice_z(i, n)) * 2 * rows_ + column(lattice_turns(i)));
      }
    });
    for (std::size_t i = 0; i < n; ++i) ++first_[cell[i] + 1];
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < n; ++i) order_[at[cell[i]]++] = static_cast<std::uint32_t>(i);
  }

  Vec3 direction(std::size_t i) const {
    return directions_.empty() ? lattice_direction(i, n_) : directions_[i];
  }
  // Calls visit(i) for all directions within an angle of a unit vector, and for some others.
  template <typename Visit>
  void visit_near(const Vec3& middle, double angle, const Visit& visit) const {
    constexpr double kMargin = 1e-9;  // above all rounding in this function
    angle += kMargin;
    const double theta = std::acos(std::clamp(middle.z, -1.0, 1.0));
    const std::size_t low = row(std::cos(std::min(kPi, theta + angle)) - kMargin);
    const std::size_t high = row(std::cos(std::max(0.0, theta - angle)) + kMargin);
    const double sine = std::sin(theta);
    // Range of longitudes; all longitudes are visited if a pole lies within the angle.
    const bool around = angle >= kPi / 2 || std::sin(angle) >= sine;
    const double reach = around ? 0 : (std::asin(std::sin(angle) / sine) + kMargin) / (2 * kPi);
    const double turns = std::atan2(middle.y, middle.x) / (2 * kPi);
    const std::size_t columns = 2 * rows_;
    const std::size_t first = around ? 0 : column(turns - reach);
    const std::size_t n =
        around ? columns : (column(turns + reach) + columns - first) % columns + 1;
    for (std::size_t r = low; r <= high; ++r) {
      for (std::size_t c = 0; c < n; ++c) {
        const std::size_t cell = r * columns + (first + c) % columns;
        for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k) visit(order_[k]);
      }
    }
  }

 private:
  static constexpr std::size_t kPerCell = 4;  // chosen

  std::size_t row(double z) const {
    const double at = (z + 1) / 2 * static_cast<double>(rows_);
    return std::min(rows_ - 1, static_cast<std::size_t>(std::max(0.0, at)));
  }
  std::size_t column(double turns) const {
    const double at = (turns - std::floor(turns)) * 2 * static_cast<double>(rows_);
    return std::min(2 * rows_ - 1, static_cast<std::size_t>(at));
  }

  std::size_t n_, rows_;
  std::vector<Vec3> directions_;
  std::vector<std::uint32_t> order_, first_;
};

// Adds two to the count of every direction in the cone of a back face. The corners are in reversed
// order, so that the face is front-facing.
void add_back(const std::array<Vec3, 3>& corners, const LatticeCells& cells,
              std::vector<int>& counts) {
  std::array<Vec3, 3> units;
  Vec3 middle;
  for (std::size_t k = 0; k < 3; ++k) middle += units[k] = normalized(corners[k]);
  middle = normalized(middle);
  double cosine = 1;
  for (const Vec3& unit : units) cosine = std::min(cosine, dot(middle, unit));
  // A cone as wide as a half space lies in no cap around its corners.
  const double angle = cosine > 1e-3 ? std::acos(std::min(1.0, cosine)) : kPi;
  cells.visit_near(middle, angle, [&](std::size_t i) {
    if (cone_contains(corners, cells.direction(i)) != 0)
      std::atomic_ref(counts[i]).fetch_add(2, std::memory_order_relaxed);
  });
}

// Returns true if rounding hides on which side of the face the centre lies, and the face may
// contain the centre. A distant face seen edge-on covers no directions, but a face that contains
// the centre covers half of them.
bool may_hold_center(const std::array<Vec3, 3>& p) {
  const double nearest = std::sqrt(std::min({dot(p[0], p[0]), dot(p[1], p[1]), dot(p[2], p[2])}));
  const double a = norm(p[0]), b = norm(p[1]), c = norm(p[2]);
  // Twice the bound of cone_contains(), for the same product.
  constexpr double kRounding = 16 * 0x1p-53;
  if (std::abs(dot(cross(p[0], p[1]), p[2])) > kRounding * a * b * c) return false;
  const double longest = std::max({norm(p[0] - p[1]), norm(p[1] - p[2]), norm(p[2] - p[0])});
  return nearest <= longest;
}

// Returns the back faces of `low`, in order, or nothing if the centre may lie on one of `low`.
std::optional<std::vector<std::uint32_t>> backs(const LocalView& view, const Vec3& center,
                                                const std::vector<std::uint32_t>& low,
                                                const Context& context) {
  constexpr std::size_t kGrain = 1024;  // chosen: some 50 us
  struct Part {
    std::vector<std::uint32_t> backs;
    bool unclear = false;
  };
  std::vector<Part> parts((low.size() + kGrain - 1) / kGrain);
  parallel_for(low.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / kGrain];
    for (std::size_t k = begin; k < end; ++k) {
      const auto corners = corners_from(view, low[k], center);
      part.unclear = part.unclear || may_hold_center(corners);
      if (dot(cross(corners[0], corners[1]), corners[2]) < 0) part.backs.push_back(low[k]);
    }
  });
  std::vector<std::uint32_t> all;
  for (const Part& part : parts) {
    if (part.unclear) return std::nullopt;
    all.insert(all.end(), part.backs.begin(), part.backs.end());
  }
  return all;
}

}  // namespace

Vec3 lattice_direction(std::size_t i, std::size_t n) {
  const double z = lattice_z(i, n);
  const double phi = 2 * kPi * lattice_turns(i);
  const double s = std::sqrt(std::max(0.0, 1 - z * z));
  return {s * std::cos(phi), s * std::sin(phi), z};
}

std::optional<int> surplus_of(const LocalView& view, const Vec3& center, const Context& context) {
  constexpr std::size_t kStarts = 8;  // number of directions in general position (chosen)
  std::optional<int> surplus;
  for (std::size_t i = 0; i < kStarts && !surplus; ++i) {
    surplus = surplus_at(view, center, lattice_direction(i, kStarts), context);
  }
  return surplus;
}

std::optional<std::vector<int>> count_meetings(const LocalView& view, const Vec3& center,
                                               std::size_t n, const std::vector<std::uint32_t>& low,
                                               const Context& context) {
  const std::optional<int> surplus = surplus_of(view, center, context);
  if (!surplus) return std::nullopt;
  const std::optional<std::vector<std::uint32_t>> turned = backs(view, center, low, context);
  if (!turned) return std::nullopt;
  std::vector<int> counts(n, *surplus);
  if (turned->empty()) return counts;
  const LatticeCells cells(n, turned->size(), context);
  constexpr std::size_t kGrain = 256;  // chosen: some 50 us
  parallel_for(turned->size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [a, b, c] = corners_from(view, (*turned)[k], center);
      add_back({a, c, b}, cells, counts);
    }
  });
  return counts;
}

}  // namespace rholm
