#include "model/atlas/atlas_aims.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// Of the tolerance: what is aimed at, and what is not worth another aim.
constexpr double kAim = 0.995, kGoodEnough = 0.97;
// An aim that changes the surface's rms by less, of its own change as logarithms, is the last.
constexpr double kStalled = 0.1;
// Between an aim that keeps the tolerance and one that does not, and between their numbers: no more
// than kGoodEnough gives away.
constexpr double kSameAim = 1.03, kSameNumbers = 1.03;
// While handles are wrong the aim is multiplied by kTighter, at most kTightenings times: half the
// tolerance in all. Of meshes 15, 38, 51, 61, 111, 115,
// 138, 338 and 460 of tests/cli/random_meshes.py three became right so, none by a looser aim.
constexpr double kTighter = 0.7;
constexpr int kTightenings = 2;

}  // namespace

double Aims::corrected(double rms) const { return aim_ * kAim * tolerance_ / rms; }

bool Aims::is_close(double rms) const { return rms >= kGoodEnough * tolerance_; }

bool Aims::is_stalled(const AimOutcome& outcome) const {
  if (outcome.met || last_.rms <= tolerance_) return outcome.numbers == last_.numbers;
  return std::log(outcome.rms / last_.rms) > kStalled * std::log(aim_ / last_aim_);
}

void Aims::remember(const AimOutcome& outcome) { last_ = outcome, last_aim_ = aim_; }

bool Aims::advance(const AimOutcome& outcome) {
  const bool near = outcome.rms <= tolerance_;
  // Where hardly anything was left to be dropped, samples are nearer than was aimed at: what comes
  // next must be nearer than that.
  if (!outcome.met && kept_ == 0) aim_ = std::min(aim_, outcome.reached);
  if (near && !outcome.whole && kept_ == 0) {
    if (++tightened_ > kTightenings) return false;
    missed_ = aim_, missed_numbers_ = outcome.numbers;
    remember(outcome);
    aim_ *= kTighter;
    return true;
  }
  if (is_stalled(outcome)) return false;
  remember(outcome);
  const bool keeps = near && outcome.whole;
  (keeps ? kept_ : missed_) = aim_;
  (keeps ? kept_numbers_ : missed_numbers_) = outcome.numbers;
  if (kept_ == 0 || !std::isfinite(missed_)) {
    aim_ = corrected(outcome.rms);
    return true;
  }
  // What lies between them spares no more.
  const double spared = static_cast<double>(kept_numbers_) / static_cast<double>(missed_numbers_);
  if (missed_ < kSameAim * kept_ || spared < kSameNumbers) return false;
  aim_ = std::sqrt(kept_ * missed_);
  return true;
}

}  // namespace rholm
