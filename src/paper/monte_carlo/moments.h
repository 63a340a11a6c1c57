// Running sums of a Monte Carlo estimate and what they say of its error.
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
// Sample number `sample` of a place: fills scratch.terms, one for each order, so that
// Pt_lm(theta) terms[m] is what it says C_lm (real part) and S_lm (imaginary part) are, summed over
// the places; returns the direction.
using DrawSample =
    std::function<Vec3(std::size_t place, std::size_t sample, SampleScratch& scratch)>;

// Over pairs of samples (a, b) of a place: sums of a + b, (a - b)^2, (a - b)^4.
struct Moments {
  explicit Moments(int degree) : sum(degree), square(degree), fourth(degree) {}

  Coefficients sum, square, fourth;
  std::size_t samples = 0;  // of each place
};

// Adds `samples` more of every place, an even number. The same bits for any number of threads.
void add_samples(const DrawSample& draw, std::size_t places, std::size_t samples, Moments& moments,
                 StageTimes& times, const Context& context, const ParallelStage& stage);

// The estimate, and its standard error: each pair's (a - b)^2 / 2 is a variance with one degree of
// freedom; added up over places, and divided by the square of the number of samples, it is that of
// the sum of the places' means.
Coefficients mean_of(const Moments& moments);
Coefficients standard_error_of(const Moments& moments);
// Wider than the standard error where few pairs make it up, so that 3 of it hold 99.73 %.
Coefficients deviation_of(const Moments& moments);

// Half width of the 99.73 % interval of Student's distribution with nu >= 1 degrees of freedom,
// over 3.
double student_factor(double nu);

}  // namespace rholm
