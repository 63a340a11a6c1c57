#include "shape/queries/triangle_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "shape/queries/morton.h"

namespace rholm {
namespace {

constexpr std::size_t kPart = std::size_t{1} << 18;  // number of triangles of a part, about 2 ms
constexpr std::size_t kMostParts = 16;
constexpr std::size_t kVisit = 8192;  // triangles between two calls of before() and after()
constexpr std::size_t kSampled = 512;
// On a surface, most cells of a Morton curve through space are empty.
constexpr int kEmptyBits = 4;
constexpr int kMostBits = 30;

// Computes keys of triangles, below 2^bits.
class Keys {
 public:
  Keys(const MeshView& mesh, TriangleKey key, const Context& context)
      : mesh_(mesh), by_vertex_(key == TriangleKey::kVertex) {
    const int bits = static_cast<int>(std::bit_width(std::max<std::size_t>(mesh.n_faces, 2)));
    bits_ = std::min(by_vertex_ ? bits : bits + kEmptyBits, kMostBits);
    if (!by_vertex_) place_vertices(context);
  }

  int bits() const { return bits_; }
  std::uint32_t of(const Triangle& t) const {
    if (by_vertex_) {
      const std::uint64_t least = std::min({t[0], t[1], t[2]});
      return least >= mesh_.n_vertices
                 ? 0
                 : static_cast<std::uint32_t>((least << bits_) / mesh_.n_vertices);
    }
    return t[0] < mesh_.n_vertices ? places_[t[0]] : 0;
  }

 private:
  // Uses a separate array: random reads from it take a quarter of the time of reads from the mesh.
  void place_vertices(const Context& context) {
    find_box();
    places_ = AlignedArray<std::uint32_t>(mesh_.n_vertices);
    parallel_for(mesh_.n_vertices, kPart, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint64_t code = morton(per_length_ * (mesh_.vertex(i) - middle_));
        places_[i] = static_cast<std::uint32_t>(code >> (3 * kMortonLevels - bits_));
      }
    });
  }
  // Computes a box from some of the vertices; vertices outside count as on its border.
  void find_box() {
    Vec3 least{HUGE_VAL, HUGE_VAL, HUGE_VAL}, most = -1.0 * least;
    const std::size_t step = std::max<std::size_t>(1, mesh_.n_vertices / (4 * kSampled));
    for (std::size_t i = 0; i < mesh_.n_vertices; i += step) {
      const Vec3 x = mesh_.vertex(i);
      least = {std::min(least.x, x.x), std::min(least.y, x.y), std::min(least.z, x.z)};
      most = {std::max(most.x, x.x), std::max(most.y, x.y), std::max(most.z, x.z)};
    }
    const double size = std::max({most.x - least.x, most.y - least.y, most.z - least.z});
    middle_ = 0.5 * (least + most);
    per_length_ = size > 0 ? 2 / size : 0;
  }

  const MeshView& mesh_;
  bool by_vertex_;
  int bits_ = 0;
  Vec3 middle_;
  double per_length_ = 0;
  AlignedArray<std::uint32_t> places_;  // keys of the vertices
};

// Sorts by high digits of the keys into buckets, then each bucket by low digits; stable.
class Sorter {
 public:
  Sorter(const MeshView& mesh, TriangleKey key, const Context& context, OrderedTriangles& result)
      : mesh_(mesh),
        keys_(mesh, key, context),
        low_bits_((keys_.bits() + 1) / 2),
        buckets_(std::size_t{1} << (keys_.bits() - low_bits_)),
        part_(std::max(kPart, (mesh.n_faces + kMostParts - 1) / kMostParts)),
        parts_((mesh.n_faces + part_ - 1) / part_),
        digits_(mesh.n_faces),
        next_(parts_ * buckets_),
        begin_(buckets_ + 1),
        corners_(result.corners.data()) {}

  // Stores the digits of each triangle, and counts each digit in each part.
  void count(const TriangleVisit& before, const TriangleVisit& after, const Context& context) {
    parallel_for(mesh_.n_faces, part_, context, {}, [&](std::size_t begin, std::size_t end) {
      std::size_t* const counts = next_.data() + begin / part_ * buckets_;
      for (std::size_t first = begin; first < end; first += kVisit) {
        const std::size_t n = std::min(kVisit, end - first);
        if (before) before(first, n);
        for (std::size_t t = first; t < first + n; ++t) {
          const std::uint32_t digit = keys_.of(mesh_.triangle(t)) >> low_bits_;
          digits_[t] = static_cast<std::uint16_t>(digit);
          ++counts[digit];
        }
        if (after) after(first, n);
      }
    });
    std::size_t at = 0;
    for (std::size_t bucket = 0; bucket < buckets_; ++bucket) {
      begin_[bucket] = at;
      for (std::size_t part = 0; part < parts_; ++part) {
        std::size_t& next = next_[part * buckets_ + bucket];
        at += std::exchange(next, at);
      }
    }
    begin_[buckets_] = at;
  }

  void fill_buckets(const TriangleVisit& after, const Context& context) {
    parallel_for(mesh_.n_faces, part_, context, {}, [&](std::size_t begin, std::size_t end) {
      std::size_t* const next = next_.data() + begin / part_ * buckets_;
      for (std::size_t first = begin; first < end; first += kVisit) {
        const std::size_t n = std::min(kVisit, end - first);
        for (std::size_t t = first; t < first + n; ++t) {
          const Triangle triangle = mesh_.triangle(t);
          std::memcpy(corners_ + 3 * next[digits_[t]]++, triangle.data(), sizeof triangle);
        }
        if (after) after(first, n);
      }
    });
    digits_ = {};
  }

  void sort_buckets(const Context& context) {
    constexpr std::size_t kTasks = 64;
    const std::size_t grain = (buckets_ + kTasks - 1) / kTasks;
    parallel_for(buckets_, grain, context, {}, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> at((std::size_t{1} << low_bits_) + 1), low;
      std::vector<Triangle> sorted;
      for (std::size_t bucket = begin; bucket < end; ++bucket) sort_bucket(bucket, at, low, sorted);
    });
  }

 private:
  void sort_bucket(std::size_t bucket, std::vector<std::uint32_t>& at,
                   std::vector<std::uint32_t>& low, std::vector<Triangle>& sorted) {
    const std::size_t n = begin_[bucket + 1] - begin_[bucket];
    if (n < 2) return;
    std::uint32_t* const corners = corners_ + 3 * begin_[bucket];
    const std::uint32_t mask = (std::uint32_t{1} << low_bits_) - 1;
    std::fill(at.begin(), at.end(), 0);
    low.resize(n);
    sorted.resize(n);
    const auto triangle = [&](std::size_t t) {
      return Triangle{corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]};
    };
    for (std::size_t t = 0; t < n; ++t) {
      low[t] = keys_.of(triangle(t)) & mask;
      ++at[low[t] + 1];
    }
    for (std::size_t k = 1; k < at.size(); ++k) at[k] += at[k - 1];
    for (std::size_t t = 0; t < n; ++t) sorted[at[low[t]]++] = triangle(t);
    std::memcpy(corners, sorted.data(), n * sizeof(Triangle));
  }

  const MeshView& mesh_;
  Keys keys_;
  int low_bits_;
  std::size_t buckets_, part_, parts_;
  std::vector<std::uint16_t> digits_;
  std::vector<std::size_t> next_, begin_;  // [part][bucket], [bucket]
  std::uint32_t* corners_;
};

}  // namespace

OrderedTriangles order_triangles(const MeshView& mesh, TriangleKey key, const TriangleVisit& before,
                                 const TriangleVisit& after, const Context& context) {
  OrderedTriangles result;
  result.corners = AlignedArray<std::uint32_t>(3 * mesh.n_faces);
  Sorter sorter(mesh, key, context, result);
  sorter.count(before, after, context);
  sorter.fill_buckets(after, context);
  sorter.sort_buckets(context);
  result.view = mesh;
  result.view.faces = reinterpret_cast<const std::byte*>(result.corners.data());
  result.view.face_stride = sizeof(Triangle);
  return result;
}

bool vertices_in_order(const MeshView& mesh) {
  constexpr double kNear = 0.2;  // chosen: part of the distance of random vertices
  if (mesh.n_vertices < 2) return true;
  const auto random_vertex = [&](std::uint64_t stream, std::size_t i) {
    const double at = random_uniform(stream, i) * static_cast<double>(mesh.n_vertices - 1);
    return static_cast<std::size_t>(at);
  };
  std::vector<double> next, any;
  for (std::size_t i = 0; i < kSampled; ++i) {
    const std::size_t v = random_vertex(1, i);
    next.push_back(norm(mesh.vertex(v + 1) - mesh.vertex(v)));
    any.push_back(norm(mesh.vertex(random_vertex(2, i)) - mesh.vertex(v)));
  }
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + kSampled / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  return median(next) < kNear * median(any);
}

}  // namespace rholm
