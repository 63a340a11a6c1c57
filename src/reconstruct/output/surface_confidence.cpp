#include "reconstruct/output/surface_confidence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
namespace rholm {
namespace {

// Distances in spacings (chosen). Points show the surface up to kReach, and nothing of it from
// kNothing on. Opposite sheets are apart if they are farther from each other than kApart.
constexpr double kReach = 2, kNothing = 4, kApart = 3;
constexpr std::size_t kBehind = 32;  // points searched for opposite ones: a disc of 3 spacings
constexpr double kOpposite = -0.5;   // cosine of normals
constexpr double kHalf = 0.5;        // confidence below which area is counted

struct Around {
  float spacing = 0;
  float apart = 1;
};

std::vector<Around> look_around(const OrderedPoints& all, const Context& context) {
  std::vector<Around> result(all.points.size());
  parallel_for(result.size(), 512, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t i = begin; i < end; ++i) {
      all.tree.nearest_to(i, all.scaled(i, kBehind) + 1, near);
      const std::size_t eighth = std::min(all.scaled(i, kCircle), near.size() - 1);
      const double spacing = spacing_of_circle(near[eighth].distance2);
      double gap = kApart * spacing;
      for (const Neighbor& other : near) {
        if (dot(all.normals[other.index], all.normals[i]) > kOpposite) continue;
        const Vec3 offset = all.points[other.index] - all.points[i];
        gap = std::min(gap, std::abs(dot(offset, all.normals[i])));
      }
      result[i].spacing = static_cast<float>(spacing);
      if (spacing > 0) result[i].apart = static_cast<float>(gap / (kApart * spacing));
    }
  });
  return result;
}

}  // namespace

ConfidenceAreas& operator+=(ConfidenceAreas& sum, const ConfidenceAreas& part) {
  sum.all += part.all, sum.unseen += part.unseen;
  sum.thin += part.thin, sum.unsure += part.unsure;
  return sum;
}

void put_areas(const ConfidenceAreas& areas, ReconstructReport& report) {
  if (!(areas.all > 0)) return;
  report.unseen_area = areas.unseen / areas.all;
  report.thin_area = areas.thin / areas.all;
  report.unsure_area = areas.unsure / areas.all;
}

ConfidenceAreas add_confidence(const OrderedPoints& all, Mesh& mesh, const Context& context) {
  ConfidenceAreas areas;
  const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                  [](const Attribute& a) { return a.name == "confidence"; });
  if (found == mesh.attributes.end()) return areas;
  const std::vector<Around> around = look_around(all, context);
  const std::size_t n = mesh.vertices.size();
  std::vector<std::uint8_t> unseen(n), thin(n);
  std::vector<double>& confidence = found->values;
  parallel_for(n, 1024, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t v = begin; v < end; ++v) {
      all.tree.nearest(mesh.vertices[v], 1, near);
      const Around& own = around[near[0].index];
      const double distance = std::sqrt(near[0].distance2) / std::max(own.spacing, 1e-30f);
      const double seen = std::clamp((kNothing - distance) / (kNothing - kReach), 0.0, 1.0);
      confidence[v] = static_cast<float>(confidence[v] * seen * own.apart);
      unseen[v] = seen < kHalf ? 1 : 0;
      thin[v] = own.apart < kHalf ? 1 : 0;
    }
  });
  for (const auto& t : mesh.faces) {
    const double third = norm(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                    mesh.vertices[t[2]] - mesh.vertices[t[0]])) /
                         6;
    for (const std::uint32_t v : t) {
      areas.all += third;
      if (unseen[v] != 0) areas.unseen += third;
      if (thin[v] != 0) areas.thin += third;
      if (confidence[v] < kHalf) areas.unsure += third;
    }
  }
  return areas;
}

}  // namespace rholm
