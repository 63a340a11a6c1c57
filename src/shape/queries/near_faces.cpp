#include "shape/queries/near_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/parallel.h"

namespace rholm {
namespace {

// Number of cells along the longest side of the balls' box and its border: 2 MiB of bits, which fit
// into a processor's cache, and coordinates of one byte.
constexpr int kFinest = 256, kCoarsest = 16;
// Cells around the box: one for all places outside, and one next to the balls' cells.
constexpr int kBorder = 2;
// Largest mean number of cells of a ball; above it, cells become larger (chosen: a
// millisecond for thousands of balls).
constexpr double kCellsOfBall = 64;
// A face that covers more cells is taken without a test.
constexpr int kCellsOfFace = 512;
// Margin of the radius for the rounding of corners near 1.
constexpr double kRounding = 1e-12;

// Indices of a cell along x, y and z.
using Cell = std::array<std::uint8_t, 3>;

struct CellRange {
  Cell first, last;

  void add(const Cell& cell) {
    for (int k = 0; k < 3; ++k) {
      first[k] = std::min(first[k], cell[k]);
      last[k] = std::max(last[k], cell[k]);
    }
  }
  int longest() const {
    return std::max({last[0] - first[0], last[1] - first[1], last[2] - first[2]});
  }
  int count() const {
    return (last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1);
  }
};

// One bit for each cell.
class Marks {
 public:
  explicit Marks(int n) : n_(n), words_(static_cast<std::size_t>(n) * n * n / 64) {}

  void set(const CellRange& cells) {
    visit(cells, [&](std::size_t word, int bit) {
      words_[word] |= std::uint64_t{1} << bit;
      return false;
    });
  }
  bool any(const CellRange& cells) const {
    return visit(cells,
                 [&](std::size_t word, int bit) { return ((words_[word] >> bit) & 1) != 0; });
  }

 private:
  // Calls look(word, bit) until it returns true; returns true if it did.
  template <typename Look>
  bool visit(const CellRange& cells, const Look& look) const {
    for (int i = cells.first[0]; i <= cells.last[0]; ++i) {
      for (int j = cells.first[1]; j <= cells.last[1]; ++j) {
        const std::size_t row = (static_cast<std::size_t>(i) * n_ + j) * n_;
        for (int k = cells.first[2]; k <= cells.last[2]; ++k) {
          if (look((row + k) / 64, static_cast<int>((row + k) % 64))) return true;
        }
      }
    }
    return false;
  }

  int n_;
  std::vector<std::uint64_t> words_;
};

// The cell of a vertex, in four bytes.
struct PlacedVertex {
  Cell cell;
  bool near;  // a ball touches the cell or one next to it
};

// A grid over the balls. Places outside are in cells of its border, which no ball touches.
class BallGrid {
 public:
  explicit BallGrid(const Balls& balls) {
    Vec3 high = {-INFINITY, -INFINITY, -INFINITY};
    low_ = {INFINITY, INFINITY, INFINITY};
    for (std::size_t i = 0; i < balls.centers.size(); ++i) {
      const auto [a, b] = corners_of(balls, i);
      low_ = {std::min(low_.x, a.x), std::min(low_.y, a.y), std::min(low_.z, a.z)};
      high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
    }
    const double longest = std::max({high.x - low_.x, high.y - low_.y, high.z - low_.z});
    const auto n_balls = static_cast<double>(balls.centers.size());
    for (n_ = kFinest;; n_ /= 2) {
      per_length_ = (n_ - 2 * kBorder - 1) / longest;
      double cells = 0;
      for (std::size_t i = 0; i < balls.centers.size(); ++i) cells += cells_of(balls, i).count();
      if (n_ == kCoarsest || cells <= kCellsOfBall * n_balls) break;
    }
    touched_ = Marks(n_);
    near_ = Marks(n_);
    for (std::size_t i = 0; i < balls.centers.size(); ++i) {
      CellRange cells = cells_of(balls, i);
      touched_.set(cells);
      for (int k = 0; k < 3; ++k) {
        --cells.first[k];
        ++cells.last[k];
      }
      near_.set(cells);
    }
  }

  PlacedVertex place(const Vec3& x) const {
    const Cell cell = cell_of(x);
    return {cell, near_.any({cell, cell})};
  }
  // Returns true if a ball may touch the face. If no ball is near corner a, and the cells of b and
  // c are next to its cell, no ball is in a cell of the face.
  bool may_touch(const PlacedVertex& a, const PlacedVertex& b, const PlacedVertex& c) const {
    CellRange range = {a.cell, a.cell};
    range.add(b.cell);
    range.add(c.cell);
    if (!a.near && range.longest() <= 1) return false;
    return range.count() > kCellsOfFace || touched_.any(range);
  }

 private:
  static std::array<Vec3, 2> corners_of(const Balls& balls, std::size_t i) {
    const double r = (1 + kRounding) * balls.radii[i] + kRounding;
    const Vec3 reach = {r, r, r};
    return {balls.centers[i] - reach, balls.centers[i] + reach};
  }
  CellRange cells_of(const Balls& balls, std::size_t i) const {
    const auto [low, high] = corners_of(balls, i);
    return {cell_of(low), cell_of(high)};
  }
  Cell cell_of(const Vec3& x) const {
    return {along(x.x - low_.x), along(x.y - low_.y), along(x.z - low_.z)};
  }
  std::uint8_t along(double x) const {
    return static_cast<std::uint8_t>(std::clamp(x * per_length_ + kBorder, 0.0, n_ - 1.0));
  }

  Vec3 low_;
  int n_ = 0;
  double per_length_ = 0;
  Marks touched_{0}, near_{0};  // cells that a ball touches; with adjacent ones
};

}  // namespace

Mesh faces_near(const MeshView& mesh, const Vec3& origin, double scale, const Balls& balls,
                const Context& context) {
  Mesh found;
  if (balls.centers.empty()) return found;
  const BallGrid grid(balls);
  constexpr std::size_t kGrain = 1 << 13;  // chosen: some 50 us
  std::vector<PlacedVertex> placed(mesh.n_vertices);
  parallel_for(mesh.n_vertices, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      placed[i] = grid.place(scale * (mesh.vertex(i) - origin));
    }
  });
  std::vector<std::vector<Vec3>> parts((mesh.n_faces + kGrain - 1) / kGrain);
  parallel_for(mesh.n_faces, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3>& corners = parts[begin / kGrain];
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle v = mesh.triangle(t);
      if (!grid.may_touch(placed[v[0]], placed[v[1]], placed[v[2]])) continue;
      for (const std::uint32_t i : v) corners.push_back(scale * (mesh.vertex(i) - origin));
    }
  });
  for (const std::vector<Vec3>& corners : parts) {
    found.vertices.insert(found.vertices.end(), corners.begin(), corners.end());
  }
  found.faces.reserve(found.vertices.size() / 3);
  for (std::uint32_t i = 0; i < found.vertices.size(); i += 3) {
    found.faces.push_back({i, i + 1, i + 2});
  }
  return found;
}

}  // namespace rholm
