// The samples of a comparison of two surfaces, of which any range can be measured by itself: by
// several threads, and by several processes that have both surfaces.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rholm/compare.h"
#include "rholm/mesh.h"
#include "rholm/topology.h"
#include "shape/queries/triangle_tree.h"
#include "surface/star/area_samples.h"

namespace rholm {

enum class Way { kForth, kBack };  // from A to B, from B to A

// Of samples: the distance to the other surface, and the angle between the normals here and there,
// in degrees; negative where the closest triangle is degenerate, it has no normal.
struct SampleDistances {
  std::vector<double> distances, angles;

  explicit SampleDistances(std::size_t n = 0) : distances(n), angles(n) {}
};

// The power of two that brings shapes with these bounds to the order of 1, so that squares can be
// formed.
double common_scale(const Bounds& a, const Bounds& b);
// Of unit length; zero for a triangle that is degenerate, which has none.
Vec3 unit_normal(const Mesh& mesh, std::uint32_t triangle);
// Between the normals at a sample and at its closest point, as in SampleDistances.
double angle_between(const Vec3& here, const Vec3& there);

class CompareSamples {
 public:
  // Throws InvalidInput for options and meshes as compare().
  CompareSamples(const Mesh& a, const Mesh& b, const CompareOptions& options);

  // What one way needs, made once: in memory for as long as this. Any thread, but not within a loop
  // if on several. Throws InvalidInput for a mesh without area.
  void prepare(Way way, const Context& context = {.threads = 1});
  // As many samples from `first` on as there is room for, once the way is prepared. Any thread.
  void measure(Way way, std::size_t first, std::span<double> distances,
               std::span<double> angles) const;

  // All samples there and back, in parts: those of one way come before those of the other.
  std::size_t n_parts() const { return 2 * parts_of_way(); }
  // Prepares, measures a part: its bytes.
  std::string work(std::size_t part);
  // Puts them where they belong. Throws Io for other bytes.
  void take(std::size_t part, std::string_view bytes, SampleDistances& forth,
            SampleDistances& back) const;

  double scale() const { return scale_; }  // of lengths: a power of two
  double diagonal() const;                 // of the bounding box of A, scaled

 private:
  struct Side {
    Mesh mesh;  // scaled
    std::optional<AreaSampler> sampler;
    std::optional<TriangleTree> tree;
    std::once_flag has_sampler, has_tree;
  };
  struct Part {
    Way way;
    std::size_t first, n;
  };
  std::size_t parts_of_way() const;
  Part part(std::size_t p) const;
  const Side& from(Way way) const { return way == Way::kForth ? a_ : b_; }
  const Side& to(Way way) const { return way == Way::kForth ? b_ : a_; }

  CompareOptions options_;
  double scale_ = 1;
  Side a_, b_;
};

}  // namespace rholm
