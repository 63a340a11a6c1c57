#include "harmonic/motion/align_search.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/aligned_array.h"
#include "base/parallel.h"
#include "harmonic/fft/fft.h"
#include "harmonic/motion/rotation_quarter.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;

// Number of samples per wave of the highest degree, for each angle. The largest sample of a crest
// then has at least 0.9 of its height.
constexpr int kSamplesPerWave = 3;

// Returns c_lm, |m| <= l, with phase: (-1)^m (C - i S) / sqrt 2, c_{l,-m} = (-1)^m conj(c_lm).
std::vector<Complex> complex_coefficients(const Coefficients& f, int l) {
  std::vector<Complex> c(2 * static_cast<std::size_t>(l) + 1);
  c[l] = f.c(l, 0);
  for (int m = 1; m <= l; ++m) {
    const Complex z = Complex(f.c(l, m), -f.s(l, m)) / std::numbers::sqrt2;
    c[l + m] = m % 2 == 0 ? z : -z;
    c[l - m] = std::conj(z);
  }
  return c;
}

Complex power_of_i(int n) {
  constexpr Complex kPowers[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  return kPowers[((n % 4) + 4) % 4];
}

// Values of the correlation, [alpha][beta][gamma], at angles 2 pi / n apart, also for beta.
class Cube {
 public:
  explicit Cube(int bandwidth)
      : n_(smooth_length(static_cast<std::size_t>(kSamplesPerWave * bandwidth + 1), 2)),
        values_(n_ * n_ * n_) {
    std::fill(values_.data(), values_.data() + n_ * n_ * n_, Complex(0));
  }

  int n() const { return static_cast<int>(n_); }
  double step() const { return 2 * std::numbers::pi / static_cast<double>(n_); }
  double value(int i, int j, int k) const { return at(i, j, k).real(); }
  Rotation rotation(int i, int j, int k) const {
    return rotation_of(EulerAngles{i * step(), j * step(), k * step()});
  }

  void add_degree(const Coefficients& a, const Coefficients& b, int l, QuarterTurn& turn);
  void transform(const Context& context);

 private:
  std::size_t wrap(int i) const {
    return static_cast<std::size_t>(i < 0 ? i + n() : i >= n() ? i - n() : i);
  }
  const Complex& at(int i, int j, int k) const {
    return values_[(wrap(i) * n_ + wrap(j)) * n_ + wrap(k)];
  }
  Complex& at(int i, int j, int k) {
    return const_cast<Complex&>(std::as_const(*this).at(i, j, k));
  }

  std::size_t n_;
  AlignedArray<Complex> values_;
};

void Cube::add_degree(const Coefficients& a, const Coefficients& b, int l, QuarterTurn& turn) {
  turn.set_degree(l);
  const std::vector<Complex> of_a = complex_coefficients(a, l), of_b = complex_coefficients(b, l);
  std::vector<Complex> right(of_a.size());
  for (int h = -l; h <= l; ++h) {
    for (int m = -l; m <= l; ++m) right[l + m] = power_of_i(-m) * turn.delta(h, m) * of_a[l + m];
    for (int m1 = -l; m1 <= l; ++m1) {
      const Complex left = power_of_i(m1) * turn.delta(h, m1) * std::conj(of_b[l + m1]);
      for (int m = -l; m <= l; ++m) at(m1, h, m) += left * right[l + m];
    }
  }
}

// Transforms the lines along each of the three angles; numbers of a line are `stride` apart.
void Cube::transform(const Context& context) {
  const ComplexFft<double> fft(n_);
  for (const std::size_t stride : {std::size_t{1}, n_, n_ * n_}) {
    const auto lines = [&](std::size_t begin, std::size_t end) {
      AlignedArray<Complex> in(n_), out(n_);
      for (std::size_t line = begin; line < end; ++line) {
        const std::size_t first = line / stride * stride * n_ + line % stride;
        for (std::size_t k = 0; k < n_; ++k) in[k] = values_[first + k * stride];
        fft.forward(in.data(), out.data());
        for (std::size_t k = 0; k < n_; ++k) values_[first + k * stride] = out[k];
      }
    };
    parallel_for(n_ * n_, n_, context, {}, lines);
  }
}

struct Peak {
  double value;
  Rotation rotation;
};

// Returns true if no neighbour is higher. Beyond beta = 0 and pi, the grid repeats rotations.
bool is_peak(const Cube& cube, int i, int j, int k) {
  const double value = cube.value(i, j, k);
  for (int di = -1; di <= 1; ++di) {
    for (int dj = -1; dj <= 1; ++dj) {
      for (int dk = -1; dk <= 1; ++dk) {
        if (cube.value(i + di, j + dj, k + dk) > value) return false;
      }
    }
  }
  return true;
}

std::vector<Peak> peaks_of(const Cube& cube) {
  std::vector<Peak> peaks;
  for (int i = 0; i < cube.n(); ++i) {
    for (int j = 0; 2 * j <= cube.n(); ++j) {
      for (int k = 0; k < cube.n(); ++k) {
        if (is_peak(cube, i, j, k)) peaks.push_back({cube.value(i, j, k), cube.rotation(i, j, k)});
      }
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.value > b.value; });
  return peaks;
}

}  // namespace

std::vector<Rotation> correlation_peaks(const Coefficients& a, const Coefficients& b, int bandwidth,
                                        std::size_t most, const Context& context) {
  Cube cube(bandwidth);
  QuarterTurn turn;
  for (int l = 1; l <= std::min({bandwidth, a.degree(), b.degree()}); ++l) {
    report_progress(context, "align", 0.5 * l / bandwidth);
    cube.add_degree(a, b, l, turn);
  }
  cube.transform(context);
  std::vector<Rotation> chosen;
  for (const Peak& peak : peaks_of(cube)) {
    if (chosen.size() == most) break;
    const bool near = std::any_of(chosen.begin(), chosen.end(), [&](const Rotation& other) {
      return angle_between(peak.rotation, other) < 2 * cube.step();
    });
    if (!near) chosen.push_back(peak.rotation);
  }
  return chosen;
}

}  // namespace rholm
