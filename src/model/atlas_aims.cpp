#include "model/atlas_aims.h"

#include <algorithm>

namespace rholm {
namespace {

constexpr double kAim = 0.995, kGoodEnough = 0.97;  // tolerances
constexpr double kStalled = 0.1;                    // of the change of the aim, as logarithms
// Between an aim that keeps the tolerance and one that does not, and between their numbers.
constexpr double kSameAim = 1.03, kSameNumbers = 1.03;
// Where handles are not right, so often.
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
  const bool keeps = outcome.rms <= tolerance_;
  if (keeps && outcome.odd) {
    if (++tightened_ > kTightenings) return false;
    remember(outcome);
    aim_ *= kTighter;
    return true;
  }
  // Where hardly anything was left to be dropped, samples are nearer than was aimed at: what comes
  // next must be nearer than that.
  if (!outcome.met && kept_ == 0) aim_ = std::min(aim_, outcome.reached);
  if (is_stalled(outcome)) return false;
  remember(outcome);
  (keeps ? kept_ : missed_) = aim_;
  (keeps ? kept_numbers_ : missed_numbers_) = static_cast<double>(outcome.numbers);
  // What lies between them spares no more.
  if (missed_ < kSameAim * kept_ || kept_numbers_ < kSameNumbers * missed_numbers_) return false;
  aim_ = kept_ > 0 && std::isfinite(missed_) ? std::sqrt(kept_ * missed_) : corrected(outcome.rms);
  return true;
}

}  // namespace rholm
