// Running sums of a Monte Carlo estimate, and the error estimates from them.
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/parallel.h"
#include "paper/monte_carlo/edge_terms.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"

namespace rholm {

struct SampleScratch {
  std::vector<std::complex<double>> terms;
  FieldScratch field;
};
// Draws sample number `sample` of a place and returns its direction. Sets scratch.terms, one for
// each order: Pt_lm(theta) terms[m], summed over the places, estimates C_lm by its real and S_lm by
// its imaginary part.
using DrawSample =
    std::function<Vec3(std::size_t place, std::size_t sample, SampleScratch& scratch)>;

// Sums of a + b, (a - b)^2 and (a - b)^4 over pairs of samples (a, b) of a place.
struct Moments {
  explicit Moments(int degree) : sum(degree), square(degree), fourth(degree) {}

  Coefficients sum, square, fourth;
  std::size_t samples = 0;  // at each place
};

// Adds `samples` more, an even number, at every place. Same bits for any number of threads.
void add_samples(const DrawSample& draw, std::size_t places, std::size_t samples, Moments& moments,
                 StageTimes& times, const Context& context, const ParallelStage& stage);

// Return the estimate and its standard error. Each pair's (a - b)^2 / 2 is a variance with one
// degree of freedom. Its sum over places, over the square of the number of samples, is the variance
// of the sum of the places' means.
Coefficients mean_of(const Moments& moments);
Coefficients standard_error_of(const Moments& moments);
// Returns more than the standard error if pairs are few, so that 3 deviations hold 99.73 %.
Coefficients deviation_of(const Moments& moments);

// Returns a third of the half width of the 99.73 % interval of Student's distribution with nu >= 1
// degrees of freedom.
double student_factor(double nu);

}  // namespace rholm
