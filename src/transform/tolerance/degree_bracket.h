// Searches between a degree whose error is too large and a degree whose error is not.
#pragma once

namespace rholm {

struct DegreeBracket {
  int bad = -1, good = 0;
  double bad_value = 0, good_value = 0;  // 0: not known
  int same_side = 0;                     // good guesses in a row; negative: bad ones
  // The guess before the last one on that side.
  int before = 0;
  double before_value = 0;

  // Returns a fiftieth of the degree: the error itself is hardly known better.
  int step() const { return good / 50 > 1 ? good / 50 : 1; }
  bool closed() const { return good - bad <= step(); }
  void add(int degree, double value, double limit);
  // Returns the next degree to try, strictly between the two unless the bracket is closed. The
  // bracket closes if the guess is right to a step.
  int guess(double limit) const;
};

}  // namespace rholm
