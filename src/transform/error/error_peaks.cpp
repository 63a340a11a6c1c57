#include "transform/error/error_peaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>

#include "base/parallel.h"
#include "shape/face.h"

namespace rholm {
namespace {

// Largest number of candidates for worst points: the first in all or, if that is more, the second
// for each site. Worst points that are kApart / L apart are separate peaks.
constexpr std::size_t kCandidates = 2048, kCandidatesOfSite = 128;
constexpr double kApart = 2;
// First step on each face around the worst points, in units of 1/L (the points are within 1.5 of
// them). Steps are halved each time: four leave at most 1/10 of 1/L, 6e-4 of a peak of that
// curvature. After the first step only the best faces go on.
constexpr double kFirstStep = 0.75;
constexpr int kRounds = 4;
// Steps to a local maximum are halved where they lead no higher. Eight halvings leave 3e-3 of 1/L,
// some 1e-5 of a peak.
constexpr int kMostHalvings = 8, kMostRounds = 40;

struct Climber {
  std::size_t face = 0;
  std::array<Vec3, 3> corners;  // relative to the centre, scaled
  FaceNormal normal;
  double a = 0, b = 0;  // weights of the first two corners
  double step = 0;      // step of the weights
  int halvings = 0;     // number of halvings of the step
  double value = 0;

  Vec3 at(double wa, double wb) const {
    return wa * corners[0] + wb * corners[1] + (1 - wa - wb) * corners[2];
  }
};

// Sets the weights of the first two corners at the direction u, in the face or on its border.
void place(const Vec3& u, Climber& climber) {
  const auto& [p, q, r] = climber.corners;
  const double wa = dot(u, cross(q, r)), wb = dot(u, cross(r, p)), wc = dot(u, cross(p, q));
  const double sum = std::max(wa, 0.0) + std::max(wb, 0.0) + std::max(wc, 0.0);
  climber.a = sum > 0 ? std::max(wa, 0.0) / sum : 0;
  climber.b = sum > 0 ? std::max(wb, 0.0) / sum : 0;
}

// Returns a climber on a face, which begins at a direction with the error `value`. Returns none if
// the face has no normal.
std::optional<Climber> climber_on(const MeshView& mesh, std::size_t t, const Vec3& center,
                                  double scale, const Vec3& direction, double value, int degree) {
  const Triangle triangle = mesh.triangle(t);
  Climber climber;
  climber.face = t;
  for (int k = 0; k < 3; ++k) {
    climber.corners[k] = scale * (mesh.vertex(triangle[k]) - center);
  }
  climber.normal = face_normal(climber.corners);
  if (climber.normal.degenerate) return std::nullopt;
  place(direction, climber);
  climber.value = value;
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, norm(climber.corners[k] - climber.corners[(k + 1) % 3]));
  }
  const double wave = kFirstStep / std::max(degree, 1) * norm(climber.at(climber.a, climber.b));
  climber.step = std::min(0.5, wave / longest);
  return climber;
}

// Finds the faces that have one of a few vertices.
class FewVertices {
 public:
  void add(std::uint32_t i) {
    vertices_.push_back(i);
    marks_[i % kMarks] = true;
  }
  // Calls visit(k, t) for the k-th vertex and each of its faces t, in ascending order.
  template <typename Visit>
  void visit_faces(const MeshView& mesh, const Context& context, const Visit& visit) const {
    if (vertices_.empty()) return;
    constexpr std::size_t kGrain = 1 << 15;  // chosen: some 50 us
    std::vector<std::vector<std::size_t>> near((mesh.n_faces + kGrain - 1) / kGrain);
    parallel_for(mesh.n_faces, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const Triangle v = mesh.triangle(t);
        if (marks_[v[0] % kMarks] || marks_[v[1] % kMarks] || marks_[v[2] % kMarks]) {
          near[begin / kGrain].push_back(t);
        }
      }
    });
    for (const std::vector<std::size_t>& part : near) {
      for (const std::size_t t : part) {
        const Triangle v = mesh.triangle(t);
        for (std::size_t k = 0; k < vertices_.size(); ++k) {
          if (std::ranges::find(v, vertices_[k]) != v.end()) visit(k, t);
        }
      }
    }
  }

 private:
  static constexpr std::size_t kMarks = 4096;  // fits into the nearest cache
  std::vector<std::uint32_t> vertices_;
  std::array<bool, kMarks> marks_ = {};
};

// Returns the climbers of each search: on the faces of its sites and, with `around`, on all faces
// that share a corner with them.
std::vector<std::vector<Climber>> climbers(const MeshView& mesh, const Vec3& center, double scale,
                                           const ErrorPoints& points,
                                           const std::vector<PeakSearch>& searches, int degree,
                                           std::size_t n_sites, bool around,
                                           const Context& context) {
  struct Start {
    std::size_t search, point;
  };
  std::vector<std::vector<Climber>> found(searches.size());
  const auto begin = [&](const Start& start, std::size_t t) {
    const auto climber = climber_on(mesh, t, center, scale, points.directions[start.point],
                                    searches[start.search].values[start.point], degree);
    if (climber) found[start.search].push_back(*climber);
  };
  FewVertices vertices;
  std::vector<Start> at_vertices;
  for (std::size_t search = 0; search < searches.size(); ++search) {
    for (const std::size_t i : worst_apart(points, searches[search].values, degree, n_sites)) {
      const std::int64_t owner = points.owners[i];
      if (owner >= 0) {
        const auto t = static_cast<std::size_t>(owner);
        begin({search, i}, t);
        if (!around) continue;
        for (const std::uint32_t corner : mesh.triangle(t)) {
          vertices.add(corner);
          at_vertices.push_back({search, i});
        }
      } else {
        vertices.add(static_cast<std::uint32_t>(-1 - owner));
        at_vertices.push_back({search, i});
      }
    }
  }
  vertices.visit_faces(mesh, context,
                       [&](std::size_t k, std::size_t t) { begin(at_vertices[k], t); });
  return found;
}

// Weights of the first two corners of a face. on_face() moves them into the face.
struct Place {
  double a, b;
};
Place on_face(double a, double b) {
  a = std::clamp(a, 0.0, 1.0);
  b = std::clamp(b, 0.0, 1.0);
  const double over = std::max(1.0, a + b);
  return {a / over, b / over};
}
void add_point(const Climber& c, const Place& at, double scale, ErrorPoints& points) {
  const Vec3 x = c.at(at.a, at.b);
  const double r = std::max(norm(x), 1e-300);
  points.add(x / r, r / scale,
             std::abs(dot(c.normal.twice_area, x)) / (norm(c.normal.twice_area) * r),
             static_cast<std::int64_t>(c.face));
}

// Moves each climber to the best of its six neighbours if that is better. Halves the steps: all of
// them, or only steps that lead no higher.
void climb(std::vector<Climber>& climbers, double scale, const ErrorAt& error, bool halve_all) {
  constexpr std::array<std::array<double, 2>, 6> kWays = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}}};
  ErrorPoints points;
  std::vector<Place> places;
  points.reserve(kWays.size() * climbers.size());
  places.reserve(kWays.size() * climbers.size());
  for (const Climber& c : climbers) {
    for (const auto& way : kWays) {
      places.push_back(on_face(c.a + c.step * way[0], c.b + c.step * way[1]));
      add_point(c, places.back(), scale, points);
    }
  }
  const std::vector<double> values = error(points);
  for (std::size_t k = 0; k < climbers.size(); ++k) {
    Climber& c = climbers[k];
    bool higher = false;
    for (std::size_t i = kWays.size() * k; i < kWays.size() * (k + 1); ++i) {
      if (!(values[i] > c.value)) continue;
      higher = true;
      c.value = values[i];
      c.a = places[i].a;
      c.b = places[i].b;
    }
    if (higher && !halve_all) continue;
    c.step /= 2;
    ++c.halvings;
  }
}

void sort_highest_first(std::vector<Climber>& climbers) {
  std::stable_sort(climbers.begin(), climbers.end(),
                   [](const Climber& a, const Climber& b) { return a.value > b.value; });
}

// Faces that share several corners with the face of a site are found several times.
void drop_copies(std::vector<Climber>& climbers) {
  const auto key = [](const Climber& c) { return std::tuple(c.face, c.a, c.b); };
  std::ranges::sort(climbers, {}, key);
  const auto copies = std::ranges::unique(climbers, {}, key);
  climbers.erase(copies.begin(), copies.end());
}

// A climber begins at the place in its face that is nearest to a site; the error may be lower
// there.
void measure(std::vector<Climber>& climbers, double scale, const ErrorAt& error) {
  ErrorPoints points;
  points.reserve(climbers.size());
  for (const Climber& c : climbers) add_point(c, {c.a, c.b}, scale, points);
  const std::vector<double> values = error(points);
  for (std::size_t k = 0; k < climbers.size(); ++k) climbers[k].value = values[k];
}

double scale_of(const ErrorPoints& points) {
  return std::exp2(-std::ilogb(std::max(largest(points.radii), 1e-300)));
}

}  // namespace

std::vector<std::size_t> worst_apart(const ErrorPoints& points, const std::vector<double>& values,
                                     int degree, std::size_t n) {
  const std::vector<std::size_t> order =
      indices_of_largest(values, std::max(kCandidates, n * kCandidatesOfSite));
  const double apart = kApart / std::max(degree, 1);
  std::vector<std::size_t> found;
  std::size_t different = 0;
  for (std::size_t k = 0; k < order.size() && different < n; ++k) {
    double nearest = 4;
    bool known = false;  // true for a copy of a known point
    for (const std::size_t i : found) {
      const Vec3 chord = points.directions[order[k]] - points.directions[i];
      const double chord2 = dot(chord, chord);
      known = known || (chord2 == 0 && points.owners[order[k]] == points.owners[i]);
      nearest = std::min(nearest, chord2);
    }
    if (known) continue;
    // Copies of a point, each on faces of its own, are one site together.
    constexpr double kSame = 1e-24;
    if (nearest > kSame && nearest <= apart * apart) continue;
    if (nearest > kSame) ++different;
    found.push_back(order[k]);
  }
  return found;
}

std::vector<double> highest_peaks(const MeshView& mesh, const Vec3& center,
                                  const ErrorPoints& points,
                                  const std::vector<PeakSearch>& searches, int degree,
                                  std::size_t n_sites, const Context& context) {
  const double scale = scale_of(points);
  std::vector<std::vector<Climber>> all =
      climbers(mesh, center, scale, points, searches, degree, n_sites, false, context);
  std::vector<double> highest;
  for (std::size_t k = 0; k < searches.size(); ++k) {
    highest.push_back(largest(searches[k].values));
    for (int round = 0; round < kRounds && !all[k].empty(); ++round) {
      climb(all[k], scale, searches[k].error, true);
      sort_highest_first(all[k]);
      if (all[k].size() > n_sites + 1) all[k].resize(n_sites + 1);
      highest[k] = std::max(highest[k], all[k][0].value);
    }
  }
  return highest;
}

Peaks local_maxima(const MeshView& mesh, const Vec3& center, const ErrorPoints& points,
                   const PeakSearch& search, int degree, std::size_t n_sites,
                   const Context& context) {
  Peaks peaks;
  const double scale = scale_of(points);
  std::vector<Climber> climbing =
      climbers(mesh, center, scale, points, {search}, degree, n_sites, true, context)[0];
  drop_copies(climbing);
  measure(climbing, scale, search.error);
  for (int round = 0; round < kMostRounds && !climbing.empty(); ++round) {
    climb(climbing, scale, search.error, false);
    sort_highest_first(climbing);
    // A climb ends at the top, or where it is too low. A step of s/L from the top of a wave of
    // degree L is s^2/2 of the top below it. The limit is twice that for two directions, and twice
    // again for faces at a shallow angle.
    const auto ends = [&, highest = climbing[0].value](const Climber& c) {
      const double step = kFirstStep * std::exp2(-c.halvings);
      return c.halvings >= kMostHalvings || c.value < (1 - 2 * step * step) * highest;
    };
    for (const Climber& c : climbing) {
      if (!ends(c)) continue;
      add_point(c, {c.a, c.b}, scale, peaks.points);
      peaks.values.push_back(c.value);
    }
    std::erase_if(climbing, ends);
  }
  for (const Climber& c : climbing) {
    add_point(c, {c.a, c.b}, scale, peaks.points);
    peaks.values.push_back(c.value);
  }
  return peaks;
}

}  // namespace rholm
