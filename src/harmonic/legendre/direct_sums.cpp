// Direct transforms at scattered directions: the phases e^{i m phi} times the sums over l of
// order_sums.h.
#include <algorithm>
#include <array>
#include <cmath>

#include "harmonic/coefficients/solid_gradient.h"
#include "harmonic/legendre/direct_sums.h"
#include "harmonic/legendre/order_sums.h"

namespace rholm {
namespace {

constexpr std::size_t kDirectionsPerTask = 256;  // chosen: well above the cost of a task

// Calls visit(m, j, cos(m phi_j), sin(m phi_j)) for every order m and the directions [begin, end).
// Powers of e^{i phi} have errors up to m rounding units, as the rounding of phi itself causes.
template <typename Visit>
void visit_phases(const DirectionBlock& block, int degree, std::size_t begin, std::size_t end,
                  const Visit& visit) {
  std::array<double, kDirectionsPerTask> c, s;
  std::fill(c.begin(), c.end(), 1.0);
  std::fill(s.begin(), s.end(), 0.0);
  for (int m = 0; m <= degree; ++m) {
    for (std::size_t j = begin; j < end; ++j) {
      const std::size_t i = j - begin;
      visit(m, j, c[i], s[i]);
      const double next = c[i] * block.cos_phi[j] - s[i] * block.sin_phi[j];
      s[i] = s[i] * block.cos_phi[j] + c[i] * block.sin_phi[j];
      c[i] = next;
    }
  }
}

// Calls work(first, count, part of the progress) for each chunk of directions.
template <typename Work>
void for_each_chunk(std::size_t n, int degree, const Work& work) {
  const std::size_t chunk = chunk_size(degree);
  for (std::size_t first = 0; first < n; first += chunk) {
    const std::size_t count = std::min(chunk, n - first);
    const double total = static_cast<double>(n);
    work(first, count,
         ParallelStage{"transform", static_cast<double>(first) / total,
                       static_cast<double>(first + count) / total});
  }
}

// Adds the sum over m of re cos(m phi_j) + im sin(m phi_j) to values[set][j].
void sum_orders(const DirectionBlock& block, int degree, std::span<const OrderTable> tables,
                std::span<double* const> values, const Context& context) {
  const Context silent{.threads = context.threads};
  parallel_for(block.size, kDirectionsPerTask, silent, {}, [&](std::size_t begin, std::size_t end) {
    visit_phases(block, degree, begin, end, [&](int m, std::size_t j, double c, double s) {
      for (std::size_t set = 0; set < tables.size(); ++set) {
        values[set][j] += tables[set].re_row(m)[j] * c + tables[set].im_row(m)[j] * s;
      }
    });
  });
}

// Returns in values[set] the function with coefficients sets[set] at every direction.
std::vector<std::vector<double>> evaluate_sets(std::span<const Coefficients> sets,
                                               std::span<const Vec3> directions,
                                               const Context& context) {
  const int degree = sets.front().degree();
  std::vector<std::vector<double>> values(sets.size(), std::vector<double>(directions.size(), 0.0));
  std::vector<OrderTable> tables(sets.size());
  for_each_chunk(directions.size(), degree,
                 [&](std::size_t first, std::size_t count, const ParallelStage& stage) {
                   const DirectionBlock block(directions.subspan(first, count));
                   for (OrderTable& table : tables) table.reset(degree, block);
                   evaluate_orders(block, sets, tables, context, stage);
                   std::vector<double*> at;
                   at.reserve(values.size());
                   for (auto& v : values) at.push_back(v.data() + first);
                   sum_orders(block, degree, tables, at, context);
                 });
  return values;
}

void add_phases(const DirectionBlock& block, std::span<const double> weights, OrderTable& table,
                int degree, const Context& context) {
  const Context silent{.threads = context.threads};
  parallel_for(block.size, kDirectionsPerTask, silent, {}, [&](std::size_t begin, std::size_t end) {
    visit_phases(block, degree, begin, end, [&](int m, std::size_t j, double c, double s) {
      table.re_row(m)[j] = weights[j] * c;
      table.im_row(m)[j] = weights[j] * s;
    });
  });
}

void add_values(std::span<const Vec3> directions, std::span<const double> weights,
                Coefficients& sum, const Context& context) {
  OrderTable table;
  for_each_chunk(directions.size(), sum.degree(),
                 [&](std::size_t first, std::size_t count, const ParallelStage& stage) {
                   const DirectionBlock block(directions.subspan(first, count));
                   table.reset(sum.degree(), block);
                   add_phases(block, weights.subspan(first, count), table, sum.degree(), context);
                   add_order_sums(block, table, sum, context, stage);
                 });
}

// Adds sum_j g_j . grad of the solid harmonics, by one sum of degree L for each component.
void add_solid_gradients(std::span<const Vec3> directions, std::span<const Vec3> vectors,
                         Coefficients& sum, const Context& context) {
  std::array<Coefficients, 3> g = {Coefficients(sum.degree()), Coefficients(sum.degree()),
                                   Coefficients(sum.degree())};
  constexpr std::array<double Vec3::*, 3> kComponents = {&Vec3::x, &Vec3::y, &Vec3::z};
  std::vector<double> component(vectors.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t j = 0; j < vectors.size(); ++j) component[j] = vectors[j].*kComponents[axis];
    add_values(directions, component, g[axis], context);
  }
  add_solid_gradient_transpose(g, sum);
}

Vec3 times(const std::array<double, 6>& h, const Vec3& v) {
  return {h[0] * v.x + h[1] * v.y + h[2] * v.z, h[1] * v.x + h[3] * v.y + h[4] * v.z,
          h[2] * v.x + h[4] * v.y + h[5] * v.z};
}

Vec3 tangential(const Vec3& v, const Vec3& u) { return v - dot(v, u) * u; }

// Adds the second derivatives of f(x/|x|) at |x| = 1, contracted with h. With R = r^l Y, the
// projection P on the tangent plane and f of degree 0,
//   h : Hess f = P h P : Hess R - l R tr(P h P) - 2 (P h u) . grad f.
// Two gradients in a row give the first term; the second has weights that are multiplied by l.
void add_hessians(std::span<const Vec3> directions, std::span<const std::array<double, 6>> hessians,
                  Coefficients& sum, const Context& context) {
  const std::size_t n = directions.size();
  std::array<std::vector<Vec3>, 3> rows;  // the rows of P h P
  std::vector<Vec3> slope(n);
  std::vector<double> trace(n);
  for (auto& row : rows) row.resize(n);
  const std::array<Vec3, 3> axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  for (std::size_t j = 0; j < n; ++j) {
    const Vec3& u = directions[j];
    for (int axis = 0; axis < 3; ++axis) {
      rows[axis][j] = tangential(times(hessians[j], tangential(axes[axis], u)), u);
    }
    trace[j] = rows[0][j].x + rows[1][j].y + rows[2][j].z;
    slope[j] = -2.0 * tangential(times(hessians[j], u), u);
  }
  std::array<Coefficients, 3> g = {Coefficients(sum.degree()), Coefficients(sum.degree()),
                                   Coefficients(sum.degree())};
  for (int axis = 0; axis < 3; ++axis)
    add_solid_gradients(directions, rows[axis], g[axis], context);
  add_solid_gradient_transpose(g, sum);
  Coefficients traces(sum.degree());
  add_values(directions, trace, traces, context);
  for (int l = 1; l <= sum.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      sum.c(l, m) -= l * traces.c(l, m);
      sum.s(l, m) -= l * traces.s(l, m);
    }
  }
  add_solid_gradients(directions, slope, sum, context);
}

}  // namespace

std::vector<double> direct_evaluate(const Coefficients& coefficients,
                                    std::span<const Vec3> directions, const Context& context) {
  return std::move(evaluate_sets({&coefficients, 1}, directions, context).front());
}

ValuesAndGradients direct_evaluate_with_gradient(const Coefficients& coefficients,
                                                 std::span<const Vec3> directions,
                                                 const Context& context) {
  auto [dx, dy, dz] = solid_gradient(coefficients);
  const std::array<Coefficients, 4> sets = {coefficients, std::move(dx), std::move(dy),
                                            std::move(dz)};
  std::vector<std::vector<double>> sums = evaluate_sets(sets, directions, context);
  ValuesAndGradients result;
  result.values = std::move(sums[0]);
  result.gradients.resize(directions.size());
  for (std::size_t j = 0; j < directions.size(); ++j) {
    result.gradients[j] = tangential({sums[1][j], sums[2][j], sums[3][j]}, directions[j]);
  }
  return result;
}

void direct_add_adjoint(const ScatteredSources& sources, Coefficients& sum,
                        const Context& context) {
  if (!sources.weights.empty()) add_values(sources.directions, sources.weights, sum, context);
  if (!sources.gradients.empty()) {
    std::vector<Vec3> vectors(sources.gradients.begin(), sources.gradients.end());
    for (std::size_t j = 0; j < vectors.size(); ++j) {
      vectors[j] = tangential(vectors[j], sources.directions[j]);
    }
    add_solid_gradients(sources.directions, vectors, sum, context);
  }
  if (!sources.hessians.empty()) {
    add_hessians(sources.directions, sources.hessians, sum, context);
  }
}

}  // namespace rholm
