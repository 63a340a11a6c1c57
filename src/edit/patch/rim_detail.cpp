// Let h be the surface minus its fit, known around the region. Conjugate gradients find h inside
// that minimises the sum of |h_p - mean of h at p's neighbours|^2 over region and first ring.
#include "edit/patch/rim_detail.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace rholm {
namespace {

// Tolerance of the solution, which is a guess anyway. Regions
// too wide for kMostSteps keep the fit in their middle.
constexpr double kTolerance = 1e-3;
constexpr int kMostSteps = 200;

struct Rim {
  std::vector<std::uint32_t> inside;  // points of the region
  std::vector<std::uint32_t> plates;  // points whose second difference counts
  // Neighbours of plates[i], once per shared triangle: begin[i] ... begin[i + 1].
  std::vector<std::uint32_t> neighbours, begin;
};

Rim make_rim(const Site& site, const Blend& blend) {
  const auto known = [&](std::uint32_t v) {
    return site.ignored[v] != 0 || (site.weights[v] > 0 && blend.weight_sums[blend.row[v]] > 0);
  };
  Rim rim;
  for (std::uint32_t i = 0; i < site.ignored.size(); ++i) {
    if (site.ignored[i] != 0) rim.inside.push_back(i);
  }
  rim.begin.push_back(0);
  for (std::uint32_t i = 0; i < site.ignored.size(); ++i) {
    if (!known(i)) continue;
    bool all = true, any = site.ignored[i] != 0;
    const std::size_t first = rim.neighbours.size();
    for (const std::uint32_t t : site.local.triangles_at(i)) {
      for (const std::uint32_t v : site.local.faces[t]) {
        if (v == i) continue;
        rim.neighbours.push_back(v);
        all = all && known(v);
        any = any || site.ignored[v] != 0;
      }
    }
    if (all && any && rim.neighbours.size() > first) {
      rim.plates.push_back(i);
      rim.begin.push_back(static_cast<std::uint32_t>(rim.neighbours.size()));
    } else {
      rim.neighbours.resize(first);
    }
  }
  return rim;
}

// Computes second differences at the plates.
void bend(const Rim& rim, const std::vector<Vec3>& h, std::vector<Vec3>& bends) {
  for (std::size_t i = 0; i < rim.plates.size(); ++i) {
    Vec3 sum;
    for (std::uint32_t k = rim.begin[i]; k < rim.begin[i + 1]; ++k) sum += h[rim.neighbours[k]];
    bends[i] = h[rim.plates[i]] - sum / static_cast<double>(rim.begin[i + 1] - rim.begin[i]);
  }
}

// Applies the transpose of bend() at the points of the region; other points become 0.
void unbend(const Site& site, const Rim& rim, const std::vector<Vec3>& bends,
            std::vector<Vec3>& h) {
  std::fill(h.begin(), h.end(), Vec3{});
  for (std::size_t i = 0; i < rim.plates.size(); ++i) {
    const Vec3 part = bends[i] / static_cast<double>(rim.begin[i + 1] - rim.begin[i]);
    h[rim.plates[i]] += bends[i];
    for (std::uint32_t k = rim.begin[i]; k < rim.begin[i + 1]; ++k) h[rim.neighbours[k]] -= part;
  }
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (site.ignored[i] == 0) h[i] = {};
  }
}

double squares(const Rim& rim, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (const std::uint32_t i : rim.inside) sum += dot(a[i], b[i]);
  return sum;
}

// Fills h in the region, where it is 0 at first; h is given around the region.
void fill(const Site& site, const Rim& rim, std::vector<Vec3>& h) {
  std::vector<Vec3> bends(rim.plates.size()), residual(h.size()), step, image(h.size());
  bend(rim, h, bends);
  unbend(site, rim, bends, residual);
  for (Vec3& r : residual) r = -1.0 * r;
  step = residual;
  double left = squares(rim, residual, residual);
  const double enough = kTolerance * kTolerance * left;
  for (int i = 0; i < kMostSteps && left > enough; ++i) {
    bend(rim, step, bends);
    unbend(site, rim, bends, image);
    const double along = squares(rim, step, image);
    if (!(along > 0)) return;
    const double length = left / along, before = left;
    for (const std::uint32_t v : rim.inside) {
      h[v] += length * step[v];
      residual[v] -= length * image[v];
    }
    left = squares(rim, residual, residual);
    for (const std::uint32_t v : rim.inside) step[v] = residual[v] + left / before * step[v];
  }
}

}  // namespace

void carry_rim_detail(const Site& site, Blend& blend) {
  const Rim rim = make_rim(site, blend);
  std::vector<Vec3> h(site.weights.size());
  for (std::size_t degree = 0; degree < kPatchDegrees; ++degree) {
    const auto move_of = [&](std::size_t i) -> Vec3& {
      return blend.moves[blend.row[i] * kPatchDegrees + degree];
    };
    // A move leads from the surface to its fit.
    for (std::size_t i = 0; i < h.size(); ++i) {
      const bool given = site.weights[i] > 0 && site.ignored[i] == 0;
      h[i] = given ? move_of(i) : Vec3{};
    }
    fill(site, rim, h);
    for (std::size_t i = 0; i < h.size(); ++i) {
      if (site.weights[i] > 0) move_of(i) = move_of(i) - h[i];
    }
  }
}

}  // namespace rholm
