#include "transform/cap_prune.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "base/parallel.h"
#include "transform/cap_blend.h"
#include "transform/cap_candidate.h"
#include "transform/cap_degrees.h"
#include "transform/cap_eval.h"
#include "transform/cap_fit.h"

namespace rholm {
namespace {

constexpr std::size_t kMostSamples = 6000;  // of a fit; of more every second, third ... is taken
// Least share in the blend that a sample counts with, where the cap is not overridden: so that it
// stays defined where others speak louder.
constexpr double kLeastShare = 0.02;
// The same where it is overridden, or misses: there it must not stray, but may be wrong.
constexpr double kMissedShare = 0.003;
// And for its own surface where it may have no samples: chosen, ten times more costs 1 % of the
// coefficients, ten times less lets a third of the caps stray.
constexpr double kOwnShare = 0.03;
constexpr double kGradientWeight = 0.1;
constexpr double kPenalty = 2e-9;
constexpr double kShrink = 0.94;  // of a support that its surface leaves
constexpr int kMostShrinks = 8;   // to 0.6: what still strays then is closed and dropped later
constexpr int kMostSteps = 5;     // to the budget

// The quadratic form of one cap's error over its coefficients, while some are dropped: the error
// grows by c_i^2 / (M^-1)_ii when c_i becomes zero and the others make the best of it.
struct Form {
  std::vector<double> coefficients, inverse;  // M^-1 [n][n]
  std::vector<std::uint8_t> kept;
  double error = 0;  // with all coefficients
  std::size_t n = 0;

  double price(std::size_t i) const {
    return coefficients[i] * coefficients[i] / inverse[i * n + i];
  }
  void drop(std::size_t i) {
    const double pivot = inverse[i * n + i], c = coefficients[i] / pivot;
    const std::vector<double> column(&inverse[i * n], &inverse[i * n] + n);
    for (std::size_t j = 0; j < n; ++j) {
      if (kept[j] == 0) continue;
      coefficients[j] -= c * column[j];
      const double factor = column[j] / pivot;
      for (std::size_t k = 0; k < n; ++k) inverse[j * n + k] -= factor * column[k];
    }
    coefficients[i] = 0;
    kept[i] = 0;
  }
};

// The surface the cap has, with little weight, so that it stays there where it has no samples, or
// leaves them to others: points on a sunflower in the plane of the seed, carried along the rays.
void add_own_surface(const Cap& cap, std::span<const double> coefficients, double spacing,
                     CapPoints& points) {
  const CapFrame& f = cap.frame;
  const double samples = std::numbers::pi * f.support * f.support / (spacing * spacing);
  const auto n = static_cast<std::size_t>(std::clamp(samples / 4, 100.0, 2000.0));
  CapPoints plane;
  for (std::size_t k = 0; k < n; ++k) {
    const double r = f.support * std::sqrt((static_cast<double>(k) + 0.5) / static_cast<double>(n));
    const double angle = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5.0));
    plane.add(r * std::cos(angle) * f.x + r * std::sin(angle) * f.y, f.z, 1);
  }
  plane.pad();
  const std::size_t stride = plane.padded();
  std::vector<double> at(3 * stride), across(3 * stride);
  cap_surface(cap, coefficients, plane, at, across);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 offset{at[k], at[stride + k], at[2 * stride + k]};
    const Vec3 normal{across[k], across[stride + k], across[2 * stride + k]};
    const Vec3 ray = offset + f.radius * f.z;
    const double cosine = dot(normal, ray) / norm(ray);
    if (!(cosine > 0.1)) continue;  // also where there is none
    points.add(offset, normal, kOwnShare * cosine * cosine * samples / static_cast<double>(n));
  }
}

// Fits a cap to the samples it speaks for, weighted by its share in the blend.
bool make_form(const SampleLevel& samples, const Blend& all, const CapVoice& voice, const Cap& cap,
               std::span<const double> own, int degree, double tolerance, Form& form) {
  CapPoints points;
  const CapFrame& f = cap.frame;
  const std::size_t step = (voice.samples.size() + kMostSamples - 1) / kMostSamples;
  double constant = 0;
  for (std::size_t i = 0; i < voice.samples.size(); i += step) {
    const std::uint32_t s = voice.samples[i];
    double share = voice.weights[i] / all.weight[s];
    share =
        std::max(share, std::abs(voice.distances[i]) < 4 * tolerance ? kLeastShare : kMissedShare);
    const Vec3 ray = samples.points[s] - f.center;
    const double cosine = dot(samples.normals[s], ray) / norm(ray);
    if (cosine < 0.1) continue;
    points.add(samples.points[s] - f.seed(), samples.normals[s],
               share * cosine * cosine * static_cast<double>(step));
  }
  add_own_surface(cap, own, samples.spacing, points);
  points.pad();
  CapFitScratch scratch;
  const CapFitOptions options{cap.basis, degree, kGradientWeight, kPenalty};
  if (points.size() == 0) return false;
  const CapSystem system = make_system(f, points, options, scratch);
  if (!system.solvable) return false;
  DegreeFits fits;
  fits.factor(system, scratch.matrix);
  form.n = fits.regular();
  // Degrees as a whole.
  while (degree > 0 && n_coefficients(cap.basis, degree) > form.n) --degree;
  form.n = std::min(form.n, n_coefficients(cap.basis, degree));
  fits.solve(form.n, form.coefficients);
  fits.invert(form.n, form.inverse);
  const double scale = 1 / (f.radius * f.radius);  // errors as lengths
  for (double& x : form.inverse) x *= scale;
  form.kept.assign(form.n, 1);
  const double* const rest = residuals(system, form.coefficients, system.third, scratch);
  for (std::size_t i = 0; i < points.size(); ++i) constant += rest[i] * rest[i];
  form.error = constant * f.radius * f.radius;
  return true;
}

struct Drop {
  double price = 0;
  std::uint32_t cap = 0, coefficient = 0;
  bool operator<(const Drop& other) const {
    if (price != other.price) return price > other.price;  // the cheapest on top
    if (cap != other.cap) return cap > other.cap;
    return coefficient > other.coefficient;
  }
};

Drop cheapest(const Form& form, std::uint32_t cap) {
  Drop drop{INFINITY, cap, 0};
  for (std::uint32_t i = 0; i < form.n; ++i) {
    if (form.kept[i] != 0 && form.price(i) < drop.price) drop = {form.price(i), cap, i};
  }
  return drop;
}

// Drops the cheapest of all caps until the sum of errors would exceed `budget`; the last price.
double drop_until(double budget, std::vector<Form>& forms) {
  double error = 0, price = 0;
  std::priority_queue<Drop> queue;
  for (std::uint32_t c = 0; c < forms.size(); ++c) {
    error += forms[c].error;
    const Drop drop = cheapest(forms[c], c);
    if (std::isfinite(drop.price)) queue.push(drop);
  }
  while (!queue.empty() && error + queue.top().price <= budget) {
    const Drop drop = queue.top();
    queue.pop();
    error += drop.price;
    price = drop.price;
    forms[drop.cap].drop(drop.coefficient);
    const Drop next = cheapest(forms[drop.cap], drop.cap);
    if (std::isfinite(next.price)) queue.push(next);
  }
  return price;
}

// The atlas with the coefficients of the forms, each cap of the least degree that holds them.
Atlas with_forms(const Atlas& atlas, const std::vector<Form>& forms) {
  Atlas result = atlas;
  result.coefficients.clear();
  for (std::size_t c = 0; c < forms.size(); ++c) {
    std::size_t used = 1;
    for (std::size_t i = 0; i < forms[c].n; ++i) {
      if (forms[c].kept[i] != 0) used = i + 1;
    }
    Cap& cap = result.caps[c];
    int degree = 0;
    while (n_coefficients(cap.basis, degree) < used) ++degree;
    cap.degree = static_cast<std::uint16_t>(degree);
    cap.first = result.coefficients.size();
    const auto first = forms[c].coefficients.begin();
    result.coefficients.insert(
        result.coefficients.end(), first,
        first + static_cast<std::ptrdiff_t>(n_coefficients(cap.basis, degree)));
  }
  return result;
}

// Supports shrink until their caps' surfaces do not leave the samples there.
void shrink_stray(const SampleLevels& samples, double stray, Atlas& atlas, const Context& context) {
  parallel_for(atlas.caps.size(), 16, context, {}, [&](std::size_t begin, std::size_t end) {
    CandidateScratch scratch;
    for (std::size_t c = begin; c < end; ++c) {
      Cap& cap = atlas.caps[c];
      for (int k = 0; k < kMostShrinks; ++k) {
        if (!strays(samples, cap, atlas.coefficients_of(cap), stray, stray, scratch)) break;
        set_support(cap, kShrink * cap.frame.support);
      }
    }
  });
}

}  // namespace

PruneReport prune(const SampleLevels& samples, const PruneOptions& options, Atlas& atlas,
                  const Context& context) {
  const SampleLevel& finest = samples.finest();
  const Blend before = blend(atlas, finest, options.band, context);
  std::vector<Form> forms(atlas.caps.size());
  parallel_for(forms.size(), 1, context, {.name = "fits"}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Cap& cap = atlas.caps[c];
      const int degree = std::min(options.max_degree, cap.degree + options.more_degrees);
      if (make_form(finest, before, before.caps[c], cap, atlas.coefficients_of(cap), degree,
                    options.tolerance, forms[c]))
        continue;
      forms[c].n = n_coefficients(cap.basis, cap.degree);
      const auto own = atlas.coefficients_of(cap);
      forms[c].coefficients.assign(own.begin(), own.end());
      forms[c].kept.assign(forms[c].n, 1);
      forms[c].inverse.assign(forms[c].n * forms[c].n, 0);
    }
  });
  // The sum of errors bounds the blend's, which is measured: a few steps to the budget that
  // uses up the tolerance.
  PruneReport report;
  double budget = options.tolerance * options.tolerance * static_cast<double>(finest.points.size());
  Atlas best;
  for (int step = 0; step < kMostSteps; ++step) {
    std::vector<Form> trial = forms;
    const double price = drop_until(budget, trial);
    Atlas pruned = with_forms(atlas, trial);
    shrink_stray(samples, options.stray, pruned, context);

    const Blend after = blend(pruned, finest, options.band, context);
    const double ratio = options.tolerance / after.rms;
    if (after.rms <= options.tolerance || step == 0 || after.rms < report.rms) {
      best = std::move(pruned);
      report = {after.rms, n_kept(best), price};
    }
    if (std::abs(ratio - 1) < 0.003) break;
    budget *= ratio * ratio;
  }
  atlas = std::move(best);
  return report;
}

std::size_t n_kept(const Atlas& atlas) {
  return static_cast<std::size_t>(std::count_if(
      atlas.coefficients.begin(), atlas.coefficients.end(), [](double c) { return c != 0; }));
}

}  // namespace rholm
