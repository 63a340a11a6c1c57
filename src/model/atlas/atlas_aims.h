// What error of the samples' blend to aim at, so that a surface is just near enough (method 7.8).
// Layer: model, private.
#pragma once

#include <cmath>
#include <cstddef>

namespace rholm {

// What came of an aim.
struct AimOutcome {
  double reached = 0, rms = 0;  // of the samples' blend; of the surface
  std::size_t numbers = 0;      // of the model
  bool met = false;             // rms is at most what is accepted, which may be over the tolerance
  bool whole = true;            // parts and handles are the shape's
};

// The surface is a little farther from the shape than the samples' blend tells, and not by a steady
// factor: aims are corrected by what is measured, then halve (as logarithms) between one that keeps
// the tolerance and one that does not. A surface that is near enough and has other handles than the
// shape does not keep it: while none does, they are tried nearer.
class Aims {
 public:
  Aims(double tolerance, double first) : tolerance_(tolerance), aim_(first) {}
  double aim() const { return aim_; }
  // The aim that would end at the tolerance if the surface's rms were in proportion.
  double corrected(double rms) const;
  // Whether that is too little below the tolerance for another aim to spare numbers.
  bool is_close(double rms) const;
  // Whether a model of so many numbers is the last one again, whose handles were wrong.
  bool repeats(std::size_t numbers) const { return !last_.whole && numbers == last_.numbers; }
  // Goes on to the next aim; false if none promises more.
  bool advance(const AimOutcome& outcome);

 private:
  bool is_stalled(const AimOutcome& outcome) const;
  void remember(const AimOutcome& outcome);

  double tolerance_, aim_, last_aim_ = 0;
  AimOutcome last_;
  double kept_ = 0, missed_ = INFINITY;  // aims
  std::size_t kept_numbers_ = 0, missed_numbers_ = 0;
  int tightened_ = 0;
};

}  // namespace rholm
