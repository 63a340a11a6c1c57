#include "atlas/compress/cap_candidate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_support.h"
#include "base/cancel.h"
#include "base/poison.h"
#include "chart/cap/cap_frame.h"

namespace rholm {
namespace {

constexpr double kOverlap = 1.3;  // radius of the fit over radius of the support (method 7.8)
// Angle to which the fit's rim is opened: even harmonics live on a hemisphere, which
// the fit nearly fills. (The full basis of small caps has no bound like this. Patches,
// whose basis has some odd harmonics too, are opened to 85 degrees: patch_cover.cpp.)
constexpr double kOpened = 88 * std::numbers::pi / 180;
constexpr double kGradientWeight = 0.3;
constexpr double kMiss = 4;          // in tolerances; samples farther off are left to smaller caps
constexpr double kMostMissed = 0.1;  // share of the samples within the support
constexpr int kLeastDegree = 2;
constexpr int kLowDegree = 7;
constexpr double kHopeless = 0.3;
// Least n . u of samples that belong to a cap: 78 degrees off the ray.
constexpr double kFacing = 0.2;
// Least cosine of the angle between a sample's normal and the seed's, to count for the axis.
constexpr double kSameSide = 0.2;
constexpr double kLeastProbes = 150, kMostProbes = 20000;
constexpr double kAgree = -0.2;  // least cosine of two normals; at creases normals differ
// Radius, in spacings, of discs without random samples: they occur less than once in 10^8 discs.
constexpr double kVoid = 2.5;

// Returns the square root of a sample's weight at this squared
// distance from the seed, without the cosine of the angle to the
// ray. The weight of small caps (cap_seed.cpp) falls faster: with
// it, igea and the Armadillo are 1 % worse, fandisk 5 %, measured.
double rim_factor(double distance2, double fit2) { return 1.15 - distance2 / fit2; }

// Gathers the patch around the seed that is visible from a centre below, as points to fit.
CapFrame gather(const SampleLevels& samples, const CandidatePlace& place, double half_angle,
                CandidateScratch& scratch) {
  const SampleLevel& level = *place.level;
  const Vec3& seed = samples.finest().points[place.seed];
  const double fit = kOverlap * place.radius, fit2 = fit * fit;
  CapFrame frame = cap_frame(seed, place.axis, place.radius, half_angle, kOpened);
  frame.dilation = dilation_between(std::atan(kOverlap * std::tan(half_angle)), kOpened);
  scratch.points.clear();
  scratch.indices.clear();
  scratch.distance2.clear();
  for (const std::uint32_t i : scratch.search.grow(level, place.start, [&](std::uint32_t i) {
         const Vec3 offset = level.points[i] - seed, ray = level.points[i] - frame.center;
         return dot(offset, offset) < fit2 && dot(level.normals[i], ray) > kFacing * norm(ray);
       })) {
    const Vec3 offset = level.points[i] - seed;
    const double d2 = dot(offset, offset);
    const Vec3 ray = level.points[i] - frame.center;
    const double weight = rim_factor(d2, fit2) * dot(level.normals[i], ray) / norm(ray);
    scratch.points.add(offset, level.normals[i], weight * weight);
    scratch.indices.push_back(i);
    scratch.distance2.push_back(d2);
  }
  scratch.points.pad();
  return frame;
}

struct Misses {
  std::size_t within = 0, missed = 0;
  double rms = 0;  // rms over the samples that are not missed
};

// Computes distances of the samples within the support: residuals without rim_factor().
// They keep the cosine, which converts distances along rays to distances from the surface.
Misses misses_of(const CapSystem& system, const CapFrame& frame, const CandidateOptions& options,
                 CandidateScratch& scratch) {
  const double* const rest = residuals(system, scratch.coefficients, false, scratch.fit);
  const double support2 = frame.support * frame.support, fit2 = kOverlap * kOverlap * support2;
  Misses misses;
  double sum = 0;
  scratch.values.resize(scratch.points.padded());
  poison_scratch(std::span(scratch.values));
  for (std::size_t i = 0; i < scratch.points.size(); ++i) {
    const double d2 = scratch.distance2[i];
    scratch.values[i] = frame.radius * rest[i] / rim_factor(d2, fit2);
    if (d2 > support2) continue;
    ++misses.within;
    if (std::abs(scratch.values[i]) > kMiss * options.tolerance) {
      ++misses.missed;
    } else {
      sum += scratch.values[i] * scratch.values[i];
    }
  }
  if (misses.within > misses.missed) {
    misses.rms = std::sqrt(sum / static_cast<double>(misses.within - misses.missed));
  }
  return misses;
}

bool good(const Misses& misses, double tolerance) {
  return misses.within > 0 && misses.rms <= tolerance &&
         static_cast<double>(misses.missed) <= kMostMissed * static_cast<double>(misses.within);
}

// Applies at the low degree: no high degree was seen to recover from this
// share of misses (0.3 occurs in 2 of 1000 cases; scripts/constants).
bool hopeless(const Misses& misses) {
  return static_cast<double>(misses.missed) > kHopeless * static_cast<double>(misses.within);
}

struct Fitted {
  int degree = 0;  // 0: no degree meets the tolerance
  Misses misses;
};

// Finds the least degree within the tolerance; its coefficients and distances stay in scratch.
Fitted fit_least_degree(const CapFrame& frame, const CandidateOptions& options,
                        CandidateScratch& scratch) {
  CapSystem system;
  int last = 0;  // last tried degree
  const auto try_degree = [&](int degree) {
    const std::size_t n = n_coefficients(CapBasis::kEven, degree);
    if (n > scratch.fit.factor.regular()) return Misses{};
    last = degree;
    scratch.fit.factor.solve(n, scratch.coefficients);
    return misses_of(system, frame, options, scratch);
  };
  // A matrix of low degree comes first: it costs a third, often suffices, and shows hopeless fits.
  int low = kLeastDegree - 1, high = 0;  // `low` fails, `high` meets the tolerance
  Misses best;                           // misses at the degree `high`
  for (const int degree : {std::min(kLowDegree, options.max_degree), options.max_degree}) {
    system = system.n > 0 ? with_degree(system, degree, scratch.fit)
                          : make_system(frame, scratch.points,
                                        {CapBasis::kEven, degree, kGradientWeight, kFewPenalty},
                                        scratch.fit);
    if (!system.solvable) return {};
    scratch.fit.factor.factor(scratch.fit.matrix.data(), system.n, kFewPivot);
    best = try_degree(degree);
    if (good(best, options.tolerance)) {
      high = degree;
      break;
    }
    if (hopeless(best)) return {};
    low = degree;
  }
  if (high == 0) return {};
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    const Misses misses = try_degree(middle);
    if (good(misses, options.tolerance)) {
      high = middle, best = misses;
    } else {
      low = middle;
    }
  }
  if (last != high) try_degree(high);
  return {high, best};
}

// Returns the highest degree that would beat the rival
// if all samples within the support were covered.
int degree_worth_it(const CandidatePlace& place, double share, const Rival& rival,
                    const CandidateOptions& options, const CandidateScratch& scratch) {
  int degree = options.max_degree;
  if (rival.value == 0) return degree;
  double most = 0;
  for (std::size_t i = 0; i < scratch.points.size(); ++i) {
    if (scratch.distance2[i] > place.radius * place.radius) continue;
    most += share * (rival.covered[place.level->base[scratch.indices[i]]] == 0);
  }
  const auto numbers = [](int l) { return n_coefficients(CapBasis::kEven, l) + kFrameNumbers; };
  while (degree > 0 && most <= rival.value * static_cast<double>(numbers(degree))) --degree;
  return degree;
}

// Lists the samples within the support that are not missed. Returns the
// largest distance of samples within the support from the seed's plane.
double list_covered(const SampleLevel& level, const CapFrame& frame, double radius,
                    double tolerance, const CandidateScratch& scratch,
                    std::vector<std::uint32_t>& covered) {
  covered.clear();
  double deviation = 0;
  for (std::size_t i = 0; i < scratch.points.size(); ++i) {
    if (scratch.distance2[i] > radius * radius) continue;
    deviation = std::max(deviation, std::abs(dot(scratch.points.offset(i), frame.z)));
    if (std::abs(scratch.values[i]) > kMiss * tolerance) continue;
    covered.push_back(level.base[scratch.indices[i]]);
  }
  return deviation;
}

}  // namespace

CandidatePlace candidate_place(const SampleLevels& samples, std::uint32_t seed, double radius,
                               const CandidateOptions& options, CandidateScratch& scratch) {
  CandidatePlace place{&samples.level_for(radius, options.samples), seed, seed, radius, {}};
  const SampleLevel& level = *place.level;
  const Vec3 &at = samples.finest().points[seed], &normal = samples.finest().normals[seed];
  if (&level != &samples.finest()) {
    level.tree.nearest(at, 1, scratch.near);
    place.start = scratch.near.front().index;
  }
  const double fit = kOverlap * radius, fit2 = fit * fit;
  for (const std::uint32_t i : scratch.search.grow(level, place.start, [&](std::uint32_t i) {
         const Vec3 offset = level.points[i] - at;
         return dot(offset, offset) < fit2 && dot(level.normals[i], normal) > kSameSide;
       })) {
    place.axis += level.normals[i];
  }
  if (!(norm(place.axis) > 0)) place.axis = normal;
  return place;
}

double gain_of(const Candidate& candidate, std::span<const std::uint8_t> covered) {
  std::size_t n = 0;
  for (const std::uint32_t i : candidate.covered) n += covered[i] == 0;
  return candidate.share * static_cast<double>(n);
}

bool make_candidate(const SampleLevels& samples, const CandidatePlace& place, double half_angle,
                    const CandidateOptions& options, const Rival& rival, CandidateScratch& scratch,
                    Candidate& candidate) {
  const SampleLevel& level = *place.level;
  const double radius = place.radius;
  const CapFrame frame = gather(samples, place, half_angle, scratch);
  candidate.share = static_cast<double>(samples.size()) / static_cast<double>(level.points.size());
  CandidateOptions own = options;
  own.max_degree = degree_worth_it(place, candidate.share, rival, options, scratch);
  if (own.max_degree < kLeastDegree) return false;
  const Fitted fitted = fit_least_degree(frame, own, scratch);
  if (fitted.degree == 0) return false;
  candidate.cap.frame = frame;
  set_support(candidate.cap, radius);
  candidate.cap.basis = CapBasis::kEven;
  candidate.cap.degree = static_cast<std::uint16_t>(fitted.degree);
  candidate.cap.error = fitted.misses.rms;
  candidate.cap.deviation =
      list_covered(level, frame, radius, options.tolerance, scratch, candidate.covered);
  candidate.coefficients = scratch.coefficients;
  candidate.rms = fitted.misses.rms;
  candidate.inside = candidate.share * static_cast<double>(fitted.misses.within);
  return !strays(samples, candidate.cap, candidate.coefficients, options.stray, radius, scratch);
}

// A sample represents a square; the distance of its corner from its centre is half its diagonal.
bool strays(const SampleLevels& samples, const Cap& cap, std::span<const double> coefficients,
            double band, double spacing, CandidateScratch& scratch) {
  const CapFrame& f = cap.frame;
  const double apart = std::max(spacing, samples.finest().spacing);
  const double wanted = std::numbers::pi * f.support * f.support / (apart * apart);
  const auto n = static_cast<std::size_t>(std::clamp(wanted, kLeastProbes, kMostProbes));
  scratch.probes.clear();
  add_sunflower(f, n, scratch.probes);
  scratch.probes.pad();
  const std::size_t stride = scratch.probes.padded();
  scratch.surface.resize(6 * stride);
  poison_scratch(std::span(scratch.surface));
  const std::span<double> values(scratch.surface);
  cap_surface(cap, coefficients, scratch.probes, values.first(3 * stride), values.last(3 * stride));
  const SampleLevel& level = samples.finest();
  const double far = band + level.spacing;                   // bound off the surface of a sample
  const double wide = std::max(far, kVoid * level.spacing);  // bound along the surface
  CancelPoll poll;
  for (std::size_t k = 0; k < n; ++k) {
    poll();
    const Vec3 at{values[k], values[stride + k], values[2 * stride + k]};
    if (!(dot(at, at) <= f.support * f.support)) continue;  // also skips points behind the centre
    const double* const across = &values[3 * stride + k];
    Neighbor near{};
    if (!level.tree.nearest_within(f.seed() + at, wide, near)) return true;
    const Vec3& normal = level.normals[near.index];
    const double agree = dot(normal, Vec3{across[0], across[stride], across[2 * stride]});
    const double height = dot(f.seed() + at - level.points[near.index], normal);
    const double off2 = height * height, along2 = std::max(0.0, near.distance2 - off2);
    if (off2 / (far * far) + along2 / (wide * wide) > 1 || agree < kAgree) return true;
  }
  return false;
}

std::vector<std::uint32_t> covered_by(const SampleLevels& samples, const Candidate& candidate,
                                      std::uint32_t seed, double tolerance,
                                      CandidateScratch& scratch) {
  const SampleLevel& level = samples.finest();
  const CapFrame& f = candidate.cap.frame;
  const double support2 = f.support * f.support;
  scratch.points.clear();
  scratch.indices.clear();
  for (const std::uint32_t i : scratch.search.grow(level, seed, [&](std::uint32_t i) {
         const Vec3 offset = level.points[i] - level.points[seed];
         const Vec3 ray = level.points[i] - f.center;
         return dot(offset, offset) < support2 && dot(level.normals[i], ray) > kFacing * norm(ray);
       })) {
    scratch.points.add(level.points[i] - level.points[seed], level.normals[i], 1);
    scratch.indices.push_back(i);
  }
  scratch.points.pad();
  scratch.values.resize(scratch.points.padded());
  poison_scratch(std::span(scratch.values));
  cap_distances(candidate.cap, candidate.coefficients, scratch.points, scratch.values);
  std::vector<std::uint32_t> covered;
  for (std::size_t i = 0; i < scratch.points.size(); ++i) {
    if (std::abs(scratch.values[i]) <= kMiss * tolerance) covered.push_back(scratch.indices[i]);
  }
  return covered;
}

}  // namespace rholm
