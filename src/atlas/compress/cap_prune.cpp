#include "atlas/compress/cap_prune.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "atlas/cap/cap_fit.h"
#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_blend.h"
#include "atlas/compress/cap_candidate.h"
#include "atlas/compress/cap_shares.h"
#include "base/parallel.h"

namespace rholm {

// Quadratic form of one cap's error over its coefficients, while some are dropped.
// If c_i becomes zero and the others adapt, the error grows by c_i^2 / (M^-1)_ii.
struct CapForm {
  std::vector<double> coefficients, inverse;  // inverse: M^-1 [n][n]
  std::vector<std::uint8_t> kept;
  double error = 0;  // error with all coefficients
  double worth = 1;  // weight of this cap's errors relative to other caps
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

// Number of shrinks for these coefficients; initially empty, which matches no cap.
struct CapShrink {
  std::vector<double> coefficients;
  int times = 0;
};

namespace {

constexpr double kShrink = 0.94;  // factor of a support whose surface leaves the samples
constexpr int kMostShrinks = 8;   // shrinks to 0.6; surfaces that still leave are dropped later
constexpr int kMostSteps = 5;     // iterations to the budget
// The blend's rms is a power of the budget: 1/2 if caps' errors were independent, less where
// caps outvote each other (scripts/constants). It is estimated from steps that change the
// budget's logarithm by at least kTelling. In smaller steps, the caps' weights change as much.
constexpr double kLeastPower = 0.25;
constexpr double kTelling = 0.02;
// A cap that would shrink below 0.7 has lost coefficients it needs; its coefficients cost
// more from then on. Chosen by scripts/atlas-figures: half the number of shrinks takes 6 %
// more numbers. Without a bound the caps at rims, for example of ears, become very small.
constexpr int kFreeShrinks = 6;
constexpr double kDearer = 4;

// Fits a cap to its points; returns false if they do not determine its coefficients.
bool fit_form(const Cap& cap, const CapPoints& points, int degree, CapForm& form) {
  CapFitScratch scratch;
  if (points.size() == 0) return false;
  const CapSystem system = make_system(cap.frame, points, share_fit(cap.basis, degree), scratch);
  if (!system.solvable) return false;
  form.n = scratch.factor.factor(scratch.matrix.data(), system.n, kFewPivot);
  // Only whole degrees are kept.
  while (degree > 0 && n_coefficients(cap.basis, degree) > form.n) --degree;
  form.n = std::min(form.n, n_coefficients(cap.basis, degree));
  scratch.factor.solve(form.n, form.coefficients);
  scratch.factor.invert(form.n, form.inverse);
  const double square = cap.frame.radius * cap.frame.radius;
  for (double& x : form.inverse) x /= square;  // converts errors to lengths
  const double* const rest = residuals(system, form.coefficients, false, scratch);
  for (std::size_t i = 0; i < points.size(); ++i) form.error += rest[i] * rest[i];
  form.error *= square;
  return true;
}

CapForm make_form(const Atlas& atlas, const Cap& cap, const CapPoints& points,
                  const PruneOptions& options) {
  CapForm form;
  const int degree = std::min(options.max_degree, cap.degree + options.more_degrees);
  if (!fit_form(cap, points, degree, form)) {
    const auto own = atlas.coefficients_of(cap);
    form.n = own.size();
    form.coefficients.assign(own.begin(), own.end());
    form.inverse.assign(form.n * form.n, 0);
  }
  form.kept.assign(form.n, 1);
  return form;
}

struct Drop {
  double price = 0;  // squared error times the cap's weight
  std::uint32_t cap = 0, coefficient = 0;
  bool operator<(const Drop& other) const {
    if (price != other.price) return price > other.price;  // the cheapest is on top
    if (cap != other.cap) return cap > other.cap;
    return coefficient > other.coefficient;
  }
};

Drop cheapest(const CapForm& form, std::uint32_t cap) {
  Drop drop{INFINITY, cap, 0};
  for (std::uint32_t i = 0; i < form.n; ++i) {
    if (form.kept[i] == 0) continue;
    const double price = form.worth * form.price(i);
    if (price < drop.price) drop = {price, cap, i};
  }
  return drop;
}

// Drops the cheapest coefficients until the error would exceed `budget`; returns the last price.
double drop_until(double budget, std::vector<CapForm>& forms) {
  double error = 0, price = 0;
  std::priority_queue<Drop> queue;
  for (std::uint32_t c = 0; c < forms.size(); ++c) {
    error += forms[c].error;
    const Drop drop = cheapest(forms[c], c);
    if (std::isfinite(drop.price)) queue.push(drop);
  }
  while (!queue.empty()) {
    const Drop drop = queue.top();
    const double more = drop.price / forms[drop.cap].worth;
    if (error + more > budget) break;
    queue.pop();
    error += more;
    price = more;
    forms[drop.cap].drop(drop.coefficient);
    const Drop next = cheapest(forms[drop.cap], drop.cap);
    if (std::isfinite(next.price)) queue.push(next);
  }
  return price;
}

// Returns the atlas with the forms' coefficients; each cap has the least sufficient degree.
Atlas with_forms(const Atlas& atlas, const std::vector<CapForm>& forms) {
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

// Shrinks supports until the caps' surfaces do not leave the samples. Results are
// reused for caps whose coefficients have not changed, which are the majority.
void shrink_stray(const SampleLevels& samples, double stray, Atlas& atlas,
                  std::vector<CapShrink>& shrinks, const Context& context) {
  parallel_for(atlas.caps.size(), 16, context, {}, [&](std::size_t begin, std::size_t end) {
    CandidateScratch scratch;
    for (std::size_t c = begin; c < end; ++c) {
      Cap& cap = atlas.caps[c];
      CapShrink& last = shrinks[c];
      const std::span<const double> own = atlas.coefficients_of(cap);
      if (!std::ranges::equal(own, last.coefficients)) {
        last.coefficients.assign(own.begin(), own.end());
        last.times = 0;
        for (Cap smaller = cap; last.times < kMostShrinks; ++last.times) {
          if (!strays(samples, smaller, own, stray, stray, scratch)) break;
          set_support(smaller, kShrink * smaller.frame.support);
        }
      }
      for (int k = 0; k < last.times; ++k) set_support(cap, kShrink * cap.frame.support);
    }
  });
}

}  // namespace

Pruning::Pruning(const SampleLevels& samples, const PruneOptions& options, const Atlas& atlas,
                 const Context& context)
    : samples_(samples),
      options_(options),
      atlas_(atlas),
      forms_(atlas.caps.size()),
      shrinks_(atlas.caps.size()),
      worth_(atlas.caps.size(), 1) {
  const SampleLevel& finest = samples.finest();
  const CapShares shares = shares_of(atlas, finest, options.band, context);
  parallel_for(forms_.size(), 1, context, {.name = "fits"},
               [&](std::size_t begin, std::size_t end) {
                 CapPoints points;
                 for (std::size_t c = begin; c < end; ++c) {
                   share_points(atlas, c, atlas.coefficients_of(atlas.caps[c]), finest, shares,
                                {.tolerance = options.tolerance}, points);
                   forms_[c] = make_form(atlas, atlas.caps[c], points, options);
                 }
               });
}

Pruning::~Pruning() = default;

// The sum of errors bounds the blend's error, which is measured.
// The budget that uses up the aim is found iteratively.
PruneReport Pruning::to(double aim, Atlas& pruned, const Context& context) {
  const SampleLevel& finest = samples_.finest();
  PruneReport report;
  double budget = budget_ > 0 ? budget_ * std::pow(aim / reached_, 1 / power_)
                              : aim * aim * static_cast<double>(finest.points.size());
  for (int step = 0; step < kMostSteps; ++step) {
    std::vector<CapForm> forms = forms_;
    for (std::size_t c = 0; c < forms.size(); ++c) forms[c].worth = worth_[c];
    const double price = drop_until(budget, forms);
    Atlas trial = with_forms(atlas_, forms);
    shrink_stray(samples_, options_.stray, trial, shrinks_, context);
    for (std::size_t c = 0; c < forms_.size(); ++c) {
      if (shrinks_[c].times > kFreeShrinks) worth_[c] *= kDearer;
    }
    agree(finest, {.tolerance = options_.tolerance, .band = options_.band}, trial, context);
    const Blend after = blend(trial, finest, options_.band, context);
    if (after.rms <= aim || step == 0 || after.rms < report.rms) {
      pruned = std::move(trial);
      report = {after.rms, n_kept(pruned), price};
    }
    const double change = budget_ > 0 ? std::log(budget / budget_) : 0;
    if (std::abs(change) > kTelling) {
      power_ = std::clamp(std::log(after.rms / reached_) / change, kLeastPower, 0.5);
    }
    budget_ = budget, reached_ = after.rms;
    const double ratio = aim / after.rms;
    if (std::abs(ratio - 1) < 0.003) break;
    budget *= std::pow(ratio, 1 / power_);
  }
  return report;
}

std::size_t n_kept(const Atlas& atlas) {
  return static_cast<std::size_t>(std::count_if(
      atlas.coefficients.begin(), atlas.coefficients.end(), [](double c) { return c != 0; }));
}

}  // namespace rholm
