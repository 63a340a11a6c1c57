#include "rholm/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/cancel.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/coordinate_error.h"
#include "shape/face.h"
#include "shape/repair/thin_faces.h"
#include "shape/simplify/plane_quadric.h"
#include "shape/simplify/simplify_part.h"
#include "shape/topology/half_edges.h"
#include "shape/topology/vertex_stars.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain = 8192;
// Share of vertices that may collapse in a pass: the cheapest 0.3, the cheaper half of them first.
// Each half is in mesh order. This is some three times as fast as the order of costs, and moves the
// surface by a hundredth more (scripts/constants).
constexpr double kShareOfPass = 0.3;
constexpr std::size_t kClasses = 2;
constexpr std::size_t kMoreOfPass = 8;  // factor if none of the cheapest may collapse
// Cheap vertices per wanted collapse, because a collapse locks the neighbours of its vertex.
constexpr std::size_t kTriesOfCollapse = 4;
// Least cosine of the angle between a triangle's old and new normal. Chosen: fans of marching cubes
// have sharp edges without meaning.
constexpr double kLeastCosine = 0.25;
constexpr double kBorderWeight = 10;  // chosen: borders are visible against the background

struct Collapse {
  float error = 0;         // weighted sum of squared distances, in mean edges
  std::uint32_t from = 0;  // the vertex that is removed
  std::size_t place = 0;   // index of the vertex it becomes among its neighbours
};

// The mesh while it shrinks: after each pass, the remaining vertices in their order.
class Simplifier {
 public:
  // For a whole mesh (is_whole), nothing is locked, the unit is its mean edge, and `error`
  // is its coordinate_error().
  Simplifier(SimplifyPart part, const SimplifyOptions& options, const Context& context,
             bool is_whole, const Vec3& error = {})
      : options_(options),
        context_(context),
        points_(std::move(part.points)),
        triangles_(std::move(part.faces)),
        given_(points_.size()),
        kinds_(std::move(part.kinds)),
        quadrics_(std::move(part.quadrics)),
        coordinate_error_(error),
        per_length_(1 / part.unit) {
    if (!is_whole) {
      origins_.resize(triangles_.size());
      std::iota(origins_.begin(), origins_.end(), 0U);
    }
    erase_flat();
    for (std::uint32_t v = 0; v < given_.size(); ++v) given_[v] = v;
    kinds_.resize(points_.size(), PartVertex::kFree);
    quadrics_.resize(points_.size());
    if (is_whole) find_scale();
    most_ = std::pow(options_.max_error * per_length_, 2);
    stars_ = make_vertex_stars(points_.size(), triangles_);
    make_quadrics();
    compact(std::vector<std::uint8_t>(points_.size(), 1));
  }

  void run() {
    const std::size_t given = triangles_.size();
    while (triangles_.size() > options_.faces) {
      report_progress(context_, "simplify",
                      static_cast<double>(given - triangles_.size()) /
                          static_cast<double>(given - options_.faces));
      stars_ = make_vertex_stars(points_.size(), triangles_);
      const std::size_t n = points_.size();
      const std::size_t wanted = (triangles_.size() - options_.faces + 1) / 2;
      std::size_t cheapest = std::max<std::size_t>(
          1, std::min(static_cast<std::size_t>(kShareOfPass * static_cast<double>(n)),
                      kTriesOfCollapse * wanted));
      while (!pass(wanted, cheapest)) {
        if (cheapest >= n) return;
        cheapest *= kMoreOfPass;
      }
      steps_.push_back({cost_, triangles_.size()});
    }
  }

  std::vector<Vec3>& points() { return points_; }
  std::vector<Triangle>& faces() { return triangles_; }
  const std::vector<std::uint32_t>& given() const { return given_; }
  std::vector<std::uint32_t>& origins() { return origins_; }
  std::vector<PlaneQuadric>& quadrics() { return quadrics_; }
  std::vector<SimplifiedPart::Step>& steps() { return steps_; }
  double error() const { return std::sqrt(largest_) / per_length_; }

 private:
  // Uses the mean edge as unit of length, so that single precision suits meshes of any unit.
  void find_scale() {
    double sum = 0;
    for (const Triangle& t : triangles_) sum += norm(points_[t[1]] - points_[t[0]]);
    if (sum > 0) per_length_ = static_cast<double>(triangles_.size()) / sum;
  }

  Vec3 offset(std::uint32_t from, std::uint32_t to) const {
    return per_length_ * (points_[to] - points_[from]);
  }

  // Adds planes of the triangles, and along borders the planes perpendicular to these.
  void make_quadrics() {
    parallel_for(points_.size(), kGrain, context_, {}, [&](std::size_t begin, std::size_t end) {
      Ring ring;
      for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
        const bool is_given = quadrics_[v].weight > 0;
        if (is_given && kinds_[v] != PartVertex::kUnlocked) continue;
        for (const std::uint32_t t : stars_.of(v)) {
          if (is_given) break;
          const Vec3 twice = twice_area(t);
          quadrics_[v].add(normalized(twice), norm(twice) / 2);
        }
        if (is_locked(v)) continue;  // at the border of this part, perhaps not of the surface
        find_ring(triangles_, stars_, v, ring);
        if (ring.kind != RingKind::kOpen) continue;
        const std::vector<std::uint32_t>& around = ring.neighbours;
        add_border(v, around[0], around[1]);
        add_border(v, around.back(), around[around.size() - 2]);
      }
    });
  }

  void add_border(std::uint32_t v, std::uint32_t along, std::uint32_t inner) {
    const Vec3 edge = offset(v, along);
    const Vec3 normal = cross(edge, cross(edge, offset(v, inner)));
    quadrics_[v].add(normalized(normal), kBorderWeight * dot(edge, edge));
  }

  Vec3 twice_area(std::uint32_t t) const {
    const Triangle& c = triangles_[t];
    return cross(offset(c[0], c[1]), offset(c[0], c[2]));
  }

  void erase_flat() {
    if (origins_.empty()) {
      std::erase_if(triangles_, has_repeated_corner);
      return;
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (has_repeated_corner(triangles_[t])) continue;
      triangles_[kept] = triangles_[t], origins_[kept] = origins_[t];
      ++kept;
    }
    triangles_.resize(kept), origins_.resize(kept);
  }

  // Drops vertices that do not stay or are in no triangle.
  void compact(std::vector<std::uint8_t> stays) {
    std::vector<std::uint8_t> used(points_.size(), 0);
    for (const Triangle& t : triangles_) used[t[0]] = used[t[1]] = used[t[2]] = 1;
    std::vector<std::uint32_t> renumbered(points_.size());
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      renumbered[v] = next;
      if (used[v] == 0 || stays[v] == 0) continue;
      points_[next] = points_[v], quadrics_[next] = quadrics_[v], given_[next] = given_[v];
      kinds_[next] = kinds_[v];
      ++next;
    }
    points_.resize(next), quadrics_.resize(next), given_.resize(next), kinds_.resize(next);
    for (Triangle& t : triangles_) {
      for (std::uint32_t& v : t) v = renumbered[v];
    }
  }

  // Makes at most `wanted` collapses with disjoint stars among the cheapest vertices.
  // Returns true if it made one.
  bool pass(std::size_t wanted, std::size_t cheapest) {
    const std::size_t n = points_.size();
    const std::vector<float> least = least_errors();
    const std::vector<float> limits = limits_of(least, cheapest);
    std::vector<std::uint32_t> becomes(n);
    for (std::uint32_t v = 0; v < n; ++v) becomes[v] = v;
    std::vector<std::uint8_t> stays(n, 1);
    locked_.assign(n, 0);
    std::size_t done = 0;
    CancelPoll poll;
    for (const float limit : limits) {
      for (std::uint32_t v = 0; v < n && done < wanted; ++v) {
        poll();
        Collapse collapse{.from = v};
        if (locked_[v] != 0 || least[v] > limit || least[v] == HUGE_VALF ||
            !find_collapse(limits.back(), collapse))
          continue;
        const std::uint32_t to = ring_.neighbours[collapse.place];
        becomes[v] = to, stays[v] = 0;
        merge(v, to);
        locked_[v] = 1;
        for (const std::uint32_t neighbour : ring_.neighbours) locked_[neighbour] = 1;
        ++done;
      }
    }
    if (done == 0) return false;
    for (const float limit : limits) {
      if (limit != HUGE_VALF) cost_ = std::max(cost_, static_cast<double>(limit));
    }
    for (Triangle& t : triangles_) {
      for (std::uint32_t& v : t) v = becomes[v];
    }
    erase_flat();
    compact(std::move(stays));
    return true;
  }

  // Returns for each vertex the least error of an allowed collapse, or infinity without one.
  std::vector<float> least_errors() const {
    std::vector<float> errors(points_.size(), HUGE_VALF);
    parallel_for(points_.size(), kGrain, context_, {}, [&](std::size_t begin, std::size_t end) {
      for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
        if (is_locked(v)) continue;
        for (const std::uint32_t t : stars_.of(v)) {
          const Triangle& c = triangles_[t];
          const std::uint32_t next = c[0] == v ? c[1] : c[1] == v ? c[2] : c[0];
          const float error = error_of(v, next);
          if (error < errors[v] && is_allowed(error, v, next)) errors[v] = error;
        }
      }
    });
    return errors;
  }

  // Returns the largest error in each class of the `count` least errors.
  static std::vector<float> limits_of(std::vector<float> errors, std::size_t count) {
    count = std::min(count, errors.size());
    std::vector<float> limits;
    for (std::size_t k = 1; k <= kClasses; ++k) {
      const auto at = errors.begin() + static_cast<std::ptrdiff_t>((count * k - 1) / kClasses);
      std::nth_element(errors.begin(), at, errors.end());
      limits.push_back(*at);
    }
    return limits;
  }

  float error_of(std::uint32_t from, std::uint32_t to) const {
    const Vec3 d = offset(from, to);
    return quadrics_[from](static_cast<float>(d.x), static_cast<float>(d.y),
                           static_cast<float>(d.z)) +
           quadrics_[to].c;
  }

  bool is_allowed(float error, std::uint32_t from, std::uint32_t to) const {
    const double weight = static_cast<double>(quadrics_[from].weight) + quadrics_[to].weight;
    return error <= most_ * weight;
  }

  void merge(std::uint32_t from, std::uint32_t to) {
    const Vec3 d = offset(from, to);
    PlaneQuadric& q = quadrics_[to];
    q.add(quadrics_[from].seen_from(static_cast<float>(d.x), static_cast<float>(d.y),
                                    static_cast<float>(d.z)));
    if (q.weight > 0) largest_ = std::max(largest_, static_cast<double>(q.c) / q.weight);
  }

  // Finds the collapse of a vertex with the least error within the limit that keeps the topology.
  // It leaves the vertex's ring in ring_.
  bool find_collapse(float limit, Collapse& collapse) {
    const std::uint32_t v = collapse.from;
    find_ring(triangles_, stars_, v, ring_);
    if (ring_.kind == RingKind::kComplex) return false;
    const std::size_t n = ring_.neighbours.size();
    ways_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      // A border vertex collapses along the border only.
      if (ring_.kind == RingKind::kOpen && i != 0 && i != n - 1) continue;
      const std::uint32_t to = ring_.neighbours[i];
      if (locked_[to] != 0) continue;
      const float error = error_of(v, to);
      if (error <= limit && is_allowed(error, v, to)) ways_.push_back({error, v, i});
    }
    std::sort(ways_.begin(), ways_.end(), [](const Collapse& a, const Collapse& b) {
      return a.error != b.error ? a.error < b.error : a.place < b.place;
    });
    const auto way = std::find_if(ways_.begin(), ways_.end(), [&](const Collapse& c) {
      return !turns_triangles(v, ring_.neighbours[c.place]) && keeps_topology(c);
    });
    if (way == ways_.end()) return false;
    collapse = *way;
    return true;
  }

  // Returns true if a triangle would turn over or lose its area.
  bool turns_triangles(std::uint32_t v, std::uint32_t to) const {
    const Vec3 d = offset(v, to);
    for (const std::uint32_t t : stars_.of(v)) {
      const Triangle& c = triangles_[t];
      if (c[0] == to || c[1] == to || c[2] == to) continue;
      const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      const Vec3 a = offset(v, c[(k + 1) % 3]);
      const Vec3 b = offset(v, c[(k + 2) % 3]);
      const Vec3 now = cross(a, b);
      const Vec3 then = cross(a - d, b - d);
      if (becomes_thin(then, a - d, b - d, c, k, to)) return true;
      if (dot(then, now) > kLeastCosine * norm(then) * norm(now)) continue;
      // The direction of a face thinner than the rounding is meaningless.
      if (!is_thin(corners(c), coordinate_error_)) return true;
    }
    return false;
  }

  std::array<Vec3, 3> corners(const Triangle& t) const {
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
  }

  // Returns true if a triangle becomes thinner than the rounding of its corners when corner k is
  // `to`. Then a and b are its edges from this corner, and `normal` is their cross product.
  bool becomes_thin(const Vec3& normal, const Vec3& a, const Vec3& b, Triangle t, std::size_t k,
                    std::uint32_t to) const {
    constexpr double kWide = 1e-2;  // chosen: few triangles need the exact test
    if (dot(normal, normal) > kWide * kWide * dot(a, a) * dot(b, b)) return false;
    t[k] = to;
    return is_thin(corners(t), coordinate_error_);
  }

  // Tests the link condition (Dey, Edelsbrunner, Guha, Nekhayev 1999). No edge of the removed
  // vertex, and no triangle, may coincide with an existing one, except at the collapsed edge.
  bool keeps_topology(const Collapse& collapse) {
    const std::vector<std::uint32_t>& around = ring_.neighbours;
    const std::size_t n = around.size();
    const bool closed = ring_.kind == RingKind::kClosed;
    const std::size_t place = collapse.place;
    find_ring(triangles_, stars_, around[place], target_);
    if (target_.kind == RingKind::kComplex) return false;
    const std::size_t before = place > 0 ? place - 1 : closed ? n - 1 : n;
    const std::size_t after = place + 1 < n ? place + 1 : closed ? 0 : n;
    if (may_meet_elsewhere(place, before, after)) return false;
    const std::vector<std::uint32_t>& there = target_.neighbours;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == place || i == before || i == after) continue;
      if (std::find(there.begin(), there.end(), around[i]) != there.end()) return false;
    }
    // Three triangles become one, which may exist already beneath: a tetrahedron stays. The last
    // triangle of an open component stays too.
    if (closed) return n > 3 || there.size() > 3 || target_.kind == RingKind::kOpen;
    return n > 2 || there.size() > 2;
  }

  // Returns true if a new edge or triangle may exist in another part already.
  bool may_meet_elsewhere(std::size_t place, std::size_t before, std::size_t after) const {
    const std::vector<std::uint32_t>& around = ring_.neighbours;
    if (!is_locked(around[place])) return false;
    bool all = true;
    for (std::size_t i = 0; i < around.size(); ++i) {
      const bool locked = is_locked(around[i]);
      if (locked && i != place && i != before && i != after) return true;
      all = all && locked;
    }
    return all && around.size() == 3;
  }
  bool is_locked(std::uint32_t v) const { return kinds_[v] == PartVertex::kLocked; }

  const SimplifyOptions& options_;
  const Context& context_;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> given_;  // given index of each vertex
  std::vector<PartVertex> kinds_;
  std::vector<PlaneQuadric> quadrics_;
  std::vector<std::uint32_t> origins_;  // for a part: given triangle that each one was
  std::vector<SimplifiedPart::Step> steps_;
  VertexStars stars_;
  std::vector<std::uint8_t> locked_;
  Ring ring_, target_;
  std::vector<Collapse> ways_;
  Vec3 coordinate_error_;  // only for a whole mesh
  double per_length_;
  double most_ = 0;     // square of the allowed error, in mean edges
  double largest_ = 0;  // square of the error, in mean edges
  double cost_ = 0;     // largest cost of collapsed vertices in all passes so far
};

void check(const SimplifyOptions& options) {
  if (!(options.max_error >= 0)) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("the error allowed is {}: it must be 0 or positive", options.max_error));
  }
  if (!(options.share >= 0 && options.share <= 1)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the share of faces is {}: it must be 0 ... 1", options.share));
  }
  if (options.faces == 0 && options.share == 0 && std::isinf(options.max_error)) {
    throw Error(ErrorCode::kInvalidInput,
                "nothing says where to stop: give a number of faces, a share of them, or an "
                "error");
  }
}

// Returns 1 for sizes near 1.
double far_scale(const Bounds& box) {
  constexpr int kFarExponent = 300;  // chosen: far below the 512 of squares
  const UnitFrame frame = unit_frame(box);
  return std::abs(frame.exponent) > kFarExponent ? frame.scale : 1;
}

void keep(std::vector<double>& values, const std::vector<std::uint32_t>& kept) {
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

}  // namespace

Simplification simplify(Mesh mesh, const SimplifyOptions& options, const Context& context) {
  validate(mesh);
  check(options);
  const auto share =
      static_cast<std::size_t>(options.share * static_cast<double>(mesh.faces.size()));
  // A power of two scales lengths if their squares would leave the range of a double.
  const double scale = far_scale(bounds(mesh.vertices));
  for (Vec3& v : mesh.vertices) v *= scale;
  std::erase_if(mesh.faces, has_repeated_corner);
  swap_thin_faces(mesh);
  const Vec3 error = coordinate_error(view_of(mesh));
  const SimplifyOptions wanted{.faces = std::max(options.faces, share),
                               .max_error = options.max_error * scale};
  SimplifyPart whole{.points = std::move(mesh.vertices), .faces = std::move(mesh.faces)};
  Simplifier simplifier(std::move(whole), wanted, context, true, error);
  simplifier.run();
  Simplification result;
  result.error = simplifier.error() / scale;
  result.mesh.vertices = std::move(simplifier.points());
  for (Vec3& v : result.mesh.vertices) v = v / scale;
  result.mesh.faces = std::move(simplifier.faces());
  result.mesh.attributes = std::move(mesh.attributes);
  for (Attribute& attribute : result.mesh.attributes) keep(attribute.values, simplifier.given());
  return result;
}

SimplifiedPart simplify_part(SimplifyPart part, std::size_t triangles, double max_error,
                             const Context& context) {
  const SimplifyOptions wanted{.faces = triangles, .max_error = max_error};
  Simplifier simplifier(std::move(part), wanted, context, false);
  simplifier.run();
  SimplifiedPart result{.faces = std::move(simplifier.faces()),
                        .origins = std::move(simplifier.origins()),
                        .vertices = simplifier.given(),
                        .quadrics = std::move(simplifier.quadrics()),
                        .error = simplifier.error(),
                        .steps = std::move(simplifier.steps())};
  for (Triangle& t : result.faces) {
    for (std::uint32_t& v : t) v = result.vertices[v];
  }
  return result;
}

}  // namespace rholm
