// Sums at scattered directions: the choice of the engine.
#include <fmt/format.h>

#include <optional>

#include "harmonic/legendre/direct_sums.h"
#include "harmonic/nonuniform/cost_model.h"
#include "harmonic/nonuniform/direction_sums.h"
#include "harmonic/nonuniform/nonuniform.h"
#include "rholm/error.h"

namespace rholm {
namespace {

void check_options(const SumOptions& options) {
  if (!(options.precision >= 1e-14 && options.precision <= 0.1)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the precision of sums must be within 1e-14 ... 0.1, not {:g}",
                            options.precision));
  }
}

void check_size(std::size_t directions, std::size_t values, const char* what) {
  if (values == 0 || directions == values) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("there are {} directions but {} {}", directions, values, what));
}

// Returns the plan for the fast engine, if that engine is wanted and cheaper.
std::optional<NonuniformPlan> fast_plan(int degree, std::size_t sources, int derivatives,
                                        const SumOptions& options) {
  check_options(options);
  if (options.engine == Engine::kDirect || sources == 0) return std::nullopt;
  const NonuniformNeeds needs{.degree = degree,
                              .allowed = options.precision,
                              .sources = sources,
                              .derivatives = derivatives};
  NonuniformPlan plan = plan_nonuniform(needs);
  if (direct_cost(needs.sources, needs.degree, needs.derivatives) <= plan.cost) return std::nullopt;
  return plan;
}

}  // namespace

EnumNames names_of(Engine) {
  static constexpr const char* kNames[] = {"fast", "direct"};
  return {"engine", kNames};
}

DirectionSums::DirectionSums(const Coefficients& coefficients, std::size_t directions,
                             bool with_gradient, const SumOptions& options, const Context& context)
    : plan_(fast_plan(coefficients.degree(), directions, with_gradient ? 1 : 0, options)) {
  if (!plan_) {
    direct_ = coefficients;
  } else if (plan_->single) {
    single_.emplace(*plan_, coefficients, context);
  } else {
    double_.emplace(*plan_, coefficients, context);
  }
}

ValuesAndGradients DirectionSums::at(std::span<const Vec3> directions, bool with_gradient,
                                     const Context& context) const {
  if (single_) return read_at(*single_, directions, with_gradient, context);
  if (double_) return read_at(*double_, directions, with_gradient, context);
  if (with_gradient) return direct_evaluate_with_gradient(*direct_, directions, context);
  return {direct_evaluate(*direct_, directions, context), {}};
}

std::vector<double> evaluate(const Coefficients& coefficients, std::span<const Vec3> directions,
                             const SumOptions& options, const Context& context) {
  const DirectionSums sums(coefficients, directions.size(), false, options, context);
  return sums.at(directions, false, context).values;
}

ValuesAndGradients evaluate_with_gradient(const Coefficients& coefficients,
                                          std::span<const Vec3> directions,
                                          const SumOptions& options, const Context& context) {
  const DirectionSums sums(coefficients, directions.size(), true, options, context);
  return sums.at(directions, true, context);
}

void add_adjoint(const ScatteredSources& sources, Coefficients& sum, const SumOptions& options,
                 const Context& context) {
  const std::size_t n = sources.directions.size();
  check_size(n, sources.weights.size(), "weights");
  check_size(n, sources.gradients.size(), "gradients");
  check_size(n, sources.hessians.size(), "Hessians");
  const int derivatives = !sources.hessians.empty() ? 2 : !sources.gradients.empty() ? 1 : 0;
  const auto plan = fast_plan(sum.degree(), n, derivatives, options);
  if (plan) {
    nonuniform_add_adjoint(*plan, sources, derivatives, sum, context);
  } else {
    direct_add_adjoint(sources, sum, context);
  }
}

}  // namespace rholm
