#include "surface/level_set/trim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rholm/error.h"

namespace rholm {
namespace {

// Least part of an edge on either side of a cut. It moves the border by at most a
// tenth of a triangle, and no cut makes a triangle thinner than a tenth of another.
constexpr double kLeastPart = 0.1;
// Number of averages along the border, which remove the zigzag of the cuts. Chosen:
// the zigzag is one or two edges long, and a border of many edges does not shrink.
constexpr int kBorderRounds = 3;
// Least ratio of a triangle's area after a move of a border vertex to its area before.
constexpr double kLeastShrink = 0.2;

// Returns the key of an edge: its lower and upper vertex.
std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

void check(const Mesh& mesh, std::span<const double> support) {
  if (support.size() != mesh.vertices.size()) {
    throw Error(ErrorCode::kInvalidInput, std::to_string(support.size()) +
                                              " values of support were given for " +
                                              std::to_string(mesh.vertices.size()) + " vertices");
  }
  for (std::size_t v = 0; v < support.size(); ++v) {
    if (std::isfinite(support[v])) continue;
    throw Error(ErrorCode::kInvalidInput,
                "the support of vertex " + std::to_string(v) + " is not finite");
  }
}

// Averages over the triangles around a vertex, weighted by area, so
// that the many tiny triangles of marching cubes have little influence.
std::vector<double> smoothed(const Mesh& mesh, std::span<const double> support,
                             const std::vector<std::uint8_t>& fixed, int rounds) {
  std::vector<double> values(support.begin(), support.end());
  std::vector<double> sums(values.size());
  std::vector<double> weights(values.size());
  for (int round = 0; round < rounds; ++round) {
    std::fill(sums.begin(), sums.end(), 0.0);
    std::fill(weights.begin(), weights.end(), 0.0);
    for (const Triangle& t : mesh.faces) {
      const Vec3& a = mesh.vertices[t[0]];
      const double area = norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
      const double mean = (values[t[0]] + values[t[1]] + values[t[2]]) / 3;
      for (const std::uint32_t v : t) {
        sums[v] += area * mean;
        weights[v] += area;
      }
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
      const bool moves = fixed.empty() || fixed[v] == 0;
      if (moves && weights[v] > 0) values[v] = sums[v] / weights[v];
    }
  }
  return values;
}

// Returns the cut edges, sorted; cut i becomes vertex i after the vertices that stay.
std::vector<std::uint64_t> find_cuts(const Mesh& mesh, const std::vector<double>& support) {
  std::vector<std::uint64_t> cuts;
  for (const Triangle& t : mesh.faces) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      if ((support[a] > 0) != (support[b] > 0)) cuts.push_back(edge_key(a, b));
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

// Origin of a vertex of the result: from + part (to - from).
struct Source {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  double part = 0;
};

class Trimmer {
 public:
  Trimmer(const Mesh& mesh, std::vector<double> support)
      : mesh_(mesh), support_(std::move(support)), cuts_(find_cuts(mesh, support_)) {}

  Mesh run() {
    number_vertices();
    for (std::uint32_t t = 0; t < mesh_.faces.size(); ++t) {
      cut(mesh_.faces[t]);
      of_.resize(result_.faces.size(), t);
    }
    result_.vertices.reserve(sources_.size());
    for (const Source& s : sources_) {
      const Vec3& from = mesh_.vertices[s.from];
      result_.vertices.push_back(from + s.part * (mesh_.vertices[s.to] - from));
    }
    for (const Attribute& attribute : mesh_.attributes) {
      Attribute trimmed{.name = attribute.name, .type = attribute.type, .values = {}};
      trimmed.values.reserve(sources_.size());
      for (const Source& s : sources_) {
        const double from = attribute.values[s.from];
        trimmed.values.push_back(from + s.part * (attribute.values[s.to] - from));
      }
      result_.attributes.push_back(std::move(trimmed));
    }
    return std::move(result_);
  }

  // Returns the vertices as TrimmedPart has them.
  std::vector<std::uint32_t> vertices() const {
    std::vector<std::uint32_t> old;
    old.reserve(n_old_);
    for (std::uint32_t v = 0; v < n_old_; ++v) old.push_back(sources_[v].from);
    return old;
  }
  std::vector<std::uint32_t>& faces() { return of_; }

  // Returns the edges along the cut, by vertices of the result.
  const std::vector<std::array<std::uint32_t, 2>>& border() const { return border_; }

 private:
  bool stays(std::uint32_t v) const { return support_[v] > 0; }

  void number_vertices() {
    std::vector<char> used(mesh_.vertices.size(), 0);
    for (const Triangle& t : mesh_.faces) {
      for (const std::uint32_t v : t) used[v] = 1;
    }
    renumbered_.resize(mesh_.vertices.size());
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v] || !stays(v)) continue;
      renumbered_[v] = static_cast<std::uint32_t>(sources_.size());
      sources_.push_back({v, v, 0});
    }
    n_old_ = static_cast<std::uint32_t>(sources_.size());
    for (const std::uint64_t key : cuts_) {
      const auto a = static_cast<std::uint32_t>(key >> 32);
      const auto b = static_cast<std::uint32_t>(key);
      const double part = support_[a] / (support_[a] - support_[b]);
      sources_.push_back({a, b, std::clamp(part, kLeastPart, 1 - kLeastPart)});
    }
  }

  std::uint32_t cut_vertex(std::uint32_t a, std::uint32_t b) const {
    const auto place = std::lower_bound(cuts_.begin(), cuts_.end(), edge_key(a, b));
    return n_old_ + static_cast<std::uint32_t>(place - cuts_.begin());
  }

  void cut(const Triangle& t) {
    const int n = stays(t[0]) + stays(t[1]) + stays(t[2]);
    if (n == 0) return;
    if (n == 3) {
      result_.faces.push_back({renumbered_[t[0]], renumbered_[t[1]], renumbered_[t[2]]});
      return;
    }
    // Corner a is alone on its side; b and c follow it.
    int lone = 0;
    while (stays(t[lone]) != (n == 1)) ++lone;
    const std::uint32_t a = t[lone];
    const std::uint32_t b = t[(lone + 1) % 3];
    const std::uint32_t c = t[(lone + 2) % 3];
    const std::uint32_t ab = cut_vertex(a, b);
    const std::uint32_t ca = cut_vertex(c, a);
    border_.push_back({ab, ca});
    if (n == 1) {
      result_.faces.push_back({renumbered_[a], ab, ca});
    } else {
      push_quad(ab, renumbered_[b], renumbered_[c], ca);
    }
  }

  Vec3 place(std::uint32_t v) const {
    const Vec3& from = mesh_.vertices[sources_[v].from];
    return from + sources_[v].part * (mesh_.vertices[sources_[v].to] - from);
  }

  // Adds two triangles along the shorter diagonal.
  void push_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (norm(place(a) - place(c)) <= norm(place(b) - place(d))) {
      result_.faces.push_back({a, b, c});
      result_.faces.push_back({a, c, d});
    } else {
      result_.faces.push_back({a, b, d});
      result_.faces.push_back({b, c, d});
    }
  }

  const Mesh& mesh_;
  std::vector<double> support_;
  std::vector<std::uint64_t> cuts_;
  std::vector<std::uint32_t> renumbered_;
  std::vector<Source> sources_;
  std::uint32_t n_old_ = 0;
  std::vector<std::array<std::uint32_t, 2>> border_;
  Mesh result_;
  std::vector<std::uint32_t> of_;  // source triangle of each triangle of the result
};

// Neighbours along the border, and triangles, of a cut vertex.
struct BorderVertex {
  std::vector<std::uint32_t> neighbours;
  std::vector<std::uint32_t> faces;
};
using BorderVertices = std::map<std::uint32_t, BorderVertex>;

BorderVertices find_border(const Mesh& mesh,
                           const std::vector<std::array<std::uint32_t, 2>>& edges) {
  BorderVertices border;
  for (const auto& [a, b] : edges) {
    border[a].neighbours.push_back(b);
    border[b].neighbours.push_back(a);
  }
  if (border.empty()) return border;
  const std::uint32_t first = border.begin()->first;  // cut vertices come last
  for (std::uint32_t t = 0; t < mesh.faces.size(); ++t) {
    for (const std::uint32_t v : mesh.faces[t]) {
      if (v >= first) border[v].faces.push_back(t);
    }
  }
  return border;
}

// Moves a vertex unless a triangle would turn over, or lose too much of its area.
void move_vertex(Mesh& mesh, std::uint32_t vertex, const BorderVertex& around, const Vec3& to) {
  const auto twice_area = [&](std::uint32_t t) {
    const Triangle& c = mesh.faces[t];
    const Vec3& a = mesh.vertices[c[0]];
    return cross(mesh.vertices[c[1]] - a, mesh.vertices[c[2]] - a);
  };
  std::vector<Vec3> before;
  before.reserve(around.faces.size());
  for (const std::uint32_t t : around.faces) before.push_back(twice_area(t));
  const Vec3 from = std::exchange(mesh.vertices[vertex], to);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vec3 after = twice_area(around.faces[i]);
    if (dot(after, before[i]) < kLeastShrink * dot(before[i], before[i])) {
      mesh.vertices[vertex] = from;
      return;
    }
  }
}

void smooth_border(Mesh& mesh, const std::vector<std::array<std::uint32_t, 2>>& edges) {
  const BorderVertices border = find_border(mesh, edges);
  for (int round = 0; round < kBorderRounds; ++round) {
    std::vector<Vec3> targets;
    for (const auto& [v, around] : border) {
      // A vertex has one neighbour only where the cut ends at an earlier border of the mesh.
      Vec3 target = mesh.vertices[v];
      if (around.neighbours.size() == 2) {
        target = 0.5 * target +
                 0.25 * (mesh.vertices[around.neighbours[0]] + mesh.vertices[around.neighbours[1]]);
      }
      targets.push_back(target);
    }
    std::size_t i = 0;
    for (const auto& [v, around] : border) move_vertex(mesh, v, around, targets[i++]);
  }
}

}  // namespace

Mesh trim(const Mesh& mesh, std::span<const double> support, int smoothing) {
  return trim_part(mesh, support, {}, smoothing).mesh;
}

TrimmedPart trim_part(const Mesh& mesh, std::span<const double> support,
                      const std::vector<std::uint8_t>& fixed, int smoothing) {
  check(mesh, support);
  Trimmer trimmer(mesh, smoothed(mesh, support, fixed, smoothing));
  TrimmedPart result{.mesh = trimmer.run(), .vertices = trimmer.vertices(), .faces = {}};
  result.faces = std::move(trimmer.faces());
  smooth_border(result.mesh, trimmer.border());
  return result;
}

}  // namespace rholm
