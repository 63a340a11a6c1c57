// Chooses signs of whole parts by their volume and the winding number.
//
// The dipole layer of the other parts has the winding number w at a part. If all signs are right, w
// continues without a jump where one part ends and another begins. So w rises towards the inside,
// against the part's normals, from the border on. This is the fixed point of Lin, Shi, Liu (2024)
// for whole parts instead of points: a part decides by the sum over its points. If the other parts
// are closed, w is constant and tells whether the part lies inside them.
#include "shape/points/orient_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shape/points/members.h"
#include "shape/queries/winding_tree.h"

namespace rholm {
namespace {

// All values are chosen. Smaller parts do not decide for themselves. The time for each part
// is a pass over all points.
constexpr std::size_t kLeastPart = 30;
constexpr std::size_t kMostParts = 64;
constexpr std::size_t kSamples = 2000;  // points of a part with computed winding numbers
constexpr int kRounds = 3;
constexpr double kDoubtful = 0.5;
// A part whose volume over area and size is below this is open. A sphere has 1/3, a closed box
// fifteen times as wide as thick has 0.05.
constexpr double kOpen = 0.02;
constexpr double kNoChange =
    0.02;  // change of the winding number across a part; the others are far or closed below it

// Returns the largest parts that decide for themselves, largest first.
std::vector<std::uint32_t> largest_of(const Members& members) {
  std::vector<std::uint32_t> parts;
  for (std::uint32_t p = 0; p + 1 < members.begin.size(); ++p) {
    if (members.size(p) >= kLeastPart) parts.push_back(p);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [&](auto a, auto b) { return members.size(a) > members.size(b); });
  if (parts.size() > kMostParts) parts.resize(kMostParts);
  return parts;
}

struct Sample {
  double area = 0;
  double behind = 0, before = 0;  // the winding number on either side

  double trust() const { return std::clamp(1 - std::abs(1 - behind) - std::abs(before), 0.0, 1.0); }
};

// Computes winding numbers `radii` radii of a patch behind and before the chosen points.
std::vector<Sample> ask_both_sides(const WindingNumbers& winding, std::span<const Vec3> points,
                                   const Patches& patches, std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> chosen, double radii) {
  std::vector<Sample> samples(chosen.size());
  std::vector<Vec3> x(2 * samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const std::uint32_t i = chosen[s];
    const double step = radii * std::numbers::inv_sqrtpi * patches.spacing[i];
    samples[s].area = patches.areas[i];
    x[2 * s] = points[i] - step * normals[i];
    x[2 * s + 1] = points[i] + step * normals[i];
  }
  const std::vector<double> w = winding(x, kWindingOpening);
  for (std::size_t s = 0; s < samples.size(); ++s) {
    samples[s].behind = w[2 * s];
    samples[s].before = w[2 * s + 1];
  }
  return samples;
}

class Sides {
 public:
  Sides(std::span<const Vec3> points, const Patches& patches, const OrientedParts& parts,
        std::vector<Vec3>& normals, const Context& context)
      : points_(points),
        patches_(patches),
        parts_(parts),
        normals_(normals),
        context_(context),
        pieces_(parts.piece, parts.n_pieces),
        components_(parts.component, parts.n_components) {
    std::vector<std::uint32_t> all(points.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    middle_ = centroid(all);
  }

  void enclose_volume() {
    for (std::size_t c = 0; c < parts_.n_components; ++c) {
      const std::span<const std::uint32_t> part = components_.of(c);
      double volume = relative_volume(part, centroid(part));
      if (std::abs(volume) < kOpen) volume = relative_volume(part, middle_);
      // A single flat part has no inside.
      if (std::abs(volume) < kOpen) volume = largest_coordinate(area_normal(part));
      if (volume < 0) turn(part);
    }
  }

  // Flips pieces one by one against all other pieces, until no piece changes.
  void agree_on_winding() {
    const std::vector<std::uint32_t> pieces = largest_of(pieces_);
    if (pieces.size() < 2) return;
    WindingTree tree(points_, area_normals({}));
    for (int round = 0; round < kRounds; ++round) {
      bool changed = false;
      for (std::size_t k = 1; k < pieces.size(); ++k) {
        const std::span<const std::uint32_t> piece = pieces_.of(pieces[k]);
        tree.set_area_normals(area_normals(piece));
        if (!wants_to_turn(tree, piece)) continue;
        turn(piece);
        changed = true;
      }
      if (!changed) return;
    }
  }

  // Returns trust 1 where winding numbers are 1 behind and 0 before every point, 0 for a plane.
  SideTrust trust() {
    SideTrust result{.of_component = std::vector<double>(parts_.n_components, 0.0)};
    const WindingTree tree(points_, area_normals({}));
    std::size_t doubtful = 0, asked = 0;
    for (const std::uint32_t c : largest_of(components_)) {
      const std::vector<Sample> samples = sample(tree, components_.of(c));
      for (const Sample& s : samples) {
        result.of_component[c] += s.trust() / static_cast<double>(samples.size());
        if (s.trust() < kDoubtful) ++doubtful;
      }
      asked += samples.size();
    }
    result.doubtful = asked > 0 ? static_cast<double>(doubtful) / static_cast<double>(asked) : 1;
    return result;
  }

 private:
  Vec3 centroid(std::span<const std::uint32_t> part) const {
    Vec3 sum;
    double area = 0;
    for (const std::uint32_t i : part) {
      sum += patches_.areas[i] * points_[i];
      area += patches_.areas[i];
    }
    return area > 0 ? sum / area : points_[part[0]];
  }

  // Returns the volume enclosed with `apex`, over the area times the rms distance from `apex`.
  double relative_volume(std::span<const std::uint32_t> part, const Vec3& apex) const {
    double volume = 0, area = 0, moment = 0;
    for (const std::uint32_t i : part) {
      const Vec3 d = points_[i] - apex;
      volume += patches_.areas[i] * dot(normals_[i], d) / 3;
      area += patches_.areas[i];
      moment += patches_.areas[i] * dot(d, d);
    }
    const double size = std::sqrt(area * moment);
    return size > 0 ? volume / size : 0;
  }

  Vec3 area_normal(std::span<const std::uint32_t> part) const {
    Vec3 sum;
    for (const std::uint32_t i : part) sum += patches_.areas[i] * normals_[i];
    return sum;
  }

  static double largest_coordinate(const Vec3& v) {
    const double yz = std::abs(v.y) > std::abs(v.z) ? v.y : v.z;
    return std::abs(v.x) > std::abs(yz) ? v.x : yz;
  }

  void turn(std::span<const std::uint32_t> part) {
    for (const std::uint32_t i : part) normals_[i] = -normals_[i];
  }

  // Returns the area normals of all points, with zeros at the points in `without`.
  std::vector<Vec3> area_normals(std::span<const std::uint32_t> without) const {
    std::vector<Vec3> result(points_.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = patches_.areas[i] * normals_[i];
    for (const std::uint32_t i : without) result[i] = {};
    return result;
  }

  std::vector<Sample> sample(const WindingTree& tree, std::span<const std::uint32_t> part) const {
    std::vector<std::uint32_t> chosen(std::min(part.size(), kSamples));
    for (std::size_t s = 0; s < chosen.size(); ++s)
      chosen[s] = part[s * part.size() / chosen.size()];
    return ask_both_sides(tree.numbers(context_), points_, patches_, normals_, chosen,
                          kClearOfPatches);
  }

  // Returns true if the piece should be flipped. `others`: the field of all other pieces.
  bool wants_to_turn(const WindingTree& others, std::span<const std::uint32_t> piece) const {
    double fall = 0, mean = 0, area = 0;
    for (const Sample& s : sample(others, piece)) {
      fall += s.area * (s.behind - s.before);
      mean += s.area * (s.behind + s.before) / 2;
      area += s.area;
    }
    if (!(area > 0)) return false;
    if (std::abs(fall) > kNoChange * area) return fall < 0;
    const bool alone = piece.size() == components_.of(parts_.component[piece[0]]).size();
    const double volume = relative_volume(piece, centroid(piece));
    if (!alone || std::abs(volume) < kOpen) return false;
    return (mean > 0.5 * area) == (volume > 0);  // a piece inside the others bounds a cavity
  }

  std::span<const Vec3> points_;
  const Patches& patches_;
  const OrientedParts& parts_;
  std::vector<Vec3>& normals_;
  const Context& context_;
  Members pieces_, components_;
  Vec3 middle_;
};

}  // namespace

SideTrust turn_outwards(std::span<const Vec3> points, const Patches& patches,
                        const OrientedParts& parts, std::vector<Vec3>& normals,
                        const Context& context) {
  Sides sides(points, patches, parts, normals, context);
  sides.enclose_volume();
  sides.agree_on_winding();
  return sides.trust();
}

double doubtful_share(std::span<const Vec3> points, const Patches& patches,
                      std::span<const Vec3> normals, const Context& context) {
  std::vector<Vec3> area_normals(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) area_normals[i] = patches.areas[i] * normals[i];
  const WindingTree tree(points, area_normals);
  const std::size_t n = std::min(points.size(), kSamples);
  std::vector<std::uint32_t> chosen(n);
  for (std::size_t s = 0; s < n; ++s) {
    chosen[s] = static_cast<std::uint32_t>(s * points.size() / n);
  }
  return static_cast<double>(count_doubtful(tree.numbers(context), points, patches, normals, chosen,
                                            kNearPatches)) /
         static_cast<double>(n);
}

std::size_t count_doubtful(const WindingNumbers& winding, std::span<const Vec3> points,
                           const Patches& patches, std::span<const Vec3> normals,
                           std::span<const std::uint32_t> chosen, double radii) {
  const std::vector<Sample> samples =
      ask_both_sides(winding, points, patches, normals, chosen, radii);
  return static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(),
                    [](const Sample& sample) { return sample.trust() < kDoubtful; }));
}

std::vector<double> trust_in_sides(std::span<const Vec3> points, const Patches& patches,
                                   std::span<const Vec3> normals, const Context& context) {
  std::vector<Vec3> area_normals(points.size());
  std::vector<std::uint32_t> all(points.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    area_normals[i] = patches.areas[i] * normals[i];
    all[i] = i;
  }
  const WindingTree tree(points, area_normals);
  std::vector<double> trust;
  trust.reserve(all.size());
  for (const Sample& s :
       ask_both_sides(tree.numbers(context), points, patches, normals, all, kNearPatches)) {
    trust.push_back(s.trust());
  }
  return trust;
}

}  // namespace rholm
