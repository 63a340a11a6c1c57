#include "surface/level_set/marching_cubes_table.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace rholm {
namespace {

// Corners of the faces x = 0, x = 1, y = 0, ..., counter-clockwise seen from outside the cube.
constexpr std::array<std::array<int, 4>, 6> kFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

int edge_between(int a, int b) {
  const int low = std::min(a, b);
  const int axis = (a ^ b) >> 1;  // 1, 2, 4 -> 0, 1, 2
  for (int e = 4 * axis; e < 4 * axis + 4; ++e) {
    if (kEdgeCorner[e] == low) return e;
  }
  return -1;
}

// Returns true if one face of the cube contains both edges.
bool share_face(int e, int f) {
  const auto touches = [](int edge, const std::array<int, 4>& face) {
    const int from = kEdgeCorner[edge];
    const int to = from | 1 << edge / 4;
    return std::count(face.begin(), face.end(), from) + std::count(face.begin(), face.end(), to) ==
           2;
  };
  return std::any_of(kFaces.begin(), kFaces.end(),
                     [&](const auto& face) { return touches(e, face) && touches(f, face); });
}

// next[e] is the crossing that follows e on its loop, -1 where e is not crossed.
// On the counter-clockwise walk around a face, a segment runs from the entry
// into the inside to the exit, around one, two or three consecutive corners.
// Loops are then counter-clockwise seen from where the values are positive.
std::array<int, 12> segments_of(int inside) {
  std::array<int, 12> next;
  next.fill(-1);
  for (const auto& face : kFaces) {
    const auto is_inside = [&](int k) { return (inside >> face[k % 4] & 1) != 0; };
    for (int k = 0; k < 4; ++k) {
      if (is_inside(k) || !is_inside(k + 1)) continue;  // the walk does not enter the inside here
      int leave = k + 1;
      while (is_inside(leave + 1)) ++leave;
      const int entered = edge_between(face[k], face[(k + 1) % 4]);
      const int left = edge_between(face[leave % 4], face[(leave + 1) % 4]);
      next[entered] = left;
    }
  }
  return next;
}

// Returns the squared distance of the middles of two edges, times 4.
int middle_distance(int e, int f) {
  int sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto middle = [axis](int edge) {
      return edge / 4 == axis ? 1 : 2 * (kEdgeCorner[edge] >> axis & 1);
    };
    const int d = middle(e) - middle(f);
    sum += d * d;
  }
  return sum;
}

// Triangulates a loop with the shortest diagonals, none of them in a face of the cube. The
// array cost_[i][j] is the cost from the loop's i-th to its j-th edge (by the usual recursion).
class LoopTriangulation {
 public:
  explicit LoopTriangulation(const std::vector<int>& loop) : loop_(loop) {
    const int n = static_cast<int>(loop.size());
    for (int span = 2; span < n; ++span) {
      for (int i = 0; i + span < n; ++i) fill(i, i + span, n);
    }
  }
  bool exists() const { return cost_[0][loop_.size() - 1] < kForbidden; }
  void append(int i, int j, SurfaceCase& result) const {
    if (j - i < 2) return;
    const int k = best_[i][j];
    append(i, k, result);
    append(k, j, result);
    std::uint8_t* corners = result.faces.data() + std::size_t{3} * result.n_faces++;
    for (const int corner : {i, k, j}) *corners++ = static_cast<std::uint8_t>(loop_[corner]);
  }

 private:
  static constexpr int kForbidden = 1 << 20;
  void fill(int i, int j, int n) {
    const bool is_diagonal = j - i < n - 1;
    int least = std::numeric_limits<int>::max();
    for (int k = i + 1; k < j; ++k) {
      if (cost_[i][k] + cost_[k][j] >= least) continue;
      least = cost_[i][k] + cost_[k][j];
      best_[i][j] = k;
    }
    int own = 0;
    if (is_diagonal) {
      own = share_face(loop_[i], loop_[j]) ? kForbidden : middle_distance(loop_[i], loop_[j]);
    }
    cost_[i][j] = std::min(least + own, kForbidden);
  }
  const std::vector<int>& loop_;
  int cost_[12][12] = {};
  int best_[12][12] = {};
};

// Returns false if the loop has no allowed triangulation. The
// rule of segments_of() excludes this; the tests check all cases.
bool append_loop(const std::vector<int>& loop, SurfaceCase& result) {
  result.n_edges = static_cast<std::uint8_t>(result.n_edges + loop.size());
  const LoopTriangulation triangulation(loop);
  if (!triangulation.exists()) return false;
  triangulation.append(0, static_cast<int>(loop.size()) - 1, result);
  return true;
}

std::array<SurfaceCase, 256> make_table() {
  std::array<SurfaceCase, 256> table;
  for (int inside = 0; inside < 256; ++inside) {
    std::array<int, 12> next = segments_of(inside);
    for (int start = 0; start < 12; ++start) {
      std::vector<int> loop;
      for (int e = start; next[e] >= 0;) {
        loop.push_back(e);
        const int following = next[e];
        next[e] = -1;
        e = following;
      }
      if (!loop.empty() && !append_loop(loop, table[inside])) table[inside].n_faces = 0;
    }
  }
  return table;
}

}  // namespace

const std::array<SurfaceCase, 256>& surface_table() {
  static const std::array<SurfaceCase, 256> table = make_table();
  return table;
}

}  // namespace rholm
