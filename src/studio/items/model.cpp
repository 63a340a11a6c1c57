#include "studio/items/model.h"

#include <algorithm>
#include <cmath>

#include "rholm/filter.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/synthesize.h"
#include "studio/items/arrays.h"

namespace rholm::studio {

std::optional<double> rms_at(const Model& model, int degree) {
  const Expansion& expansion = model.expansion;
  if (model.beyond) {
    if (const auto& rms = model.beyond->rms[static_cast<std::size_t>(degree)]) return rms;
  }
  const bool whole = degree == expansion.coefficients.degree();
  if (!whole || !expansion.errors || expansion.function != RadialFunction::kRadius) return {};
  return expansion.errors->rms;
}

namespace {

// Equal to the default of `rholm synthesize`: two vertices per coefficient, 10 4^4 + 2 ... 10 4^7 +
// 2.
int subdivisions_for(int degree) {
  const double wanted = 2 * (degree + 1.0) * (degree + 1.0);
  int n = 4;
  for (double vertices = 10.0 * 256 + 2; n < 7 && vertices < wanted; ++n) {
    vertices = 4 * vertices - 6;
  }
  return n;
}

bool is_gauge(const Model& model) { return model.expansion.function == RadialFunction::kGauge; }

std::vector<double> values_of_shape(const Mesh& shape, const Vec3& center, bool gauge) {
  std::vector<double> values;
  values.reserve(shape.vertices.size());
  for (const Vec3& v : shape.vertices) {
    const double r = norm(v - center);
    values.push_back(gauge ? 1 / r : r);
  }
  return values;
}

std::vector<double> largest_errors(const Model& model) {
  std::vector<double> largest;
  for (int d = 0; d <= model.table->degree(); ++d) {
    const std::span<const float> row = model.table->cut_off_at(d);
    double max = 0;
    for (std::size_t j = 0; j < row.size(); ++j) {
      const double base = model.base[j], f = base + double{row[j]};
      max = std::max(max, is_gauge(model) ? std::abs(1 / f - 1 / base) : std::abs(double{row[j]}));
    }
    largest.push_back(max);
  }
  return largest;
}

// Returns the function with this look, minus the base.
std::vector<float> differences(const Model& model, const Look& look, const Context& context) {
  if (model.table && look.gains.empty()) {
    const std::span<const float> row = model.table->cut_off_at(look.degree);
    return {row.begin(), row.end()};
  }
  if (model.table) return model.table->filtered(look.gains, model.base);
  const std::vector<double> values =
      evaluate(expansion_of(model, look).coefficients, model.directions.vertices,
               {.engine = Engine::kFast, .precision = 1e-6}, context);
  std::vector<float> left(values.size());
  for (std::size_t j = 0; j < values.size(); ++j) {
    left[j] = static_cast<float>(values[j] - model.base[j]);
  }
  return left;
}

}  // namespace

std::shared_ptr<const Model> make_model(Expansion expansion, std::shared_ptr<const Mesh> original,
                                        const Context& context) {
  require_surface(expansion);
  auto model = std::make_shared<Model>();
  model->expansion = std::move(expansion);
  model->original = std::move(original);
  const Coefficients& coefficients = model->expansion.coefficients;
  model->power = power_spectrum(coefficients);
  if (model->original) {
    model->directions = directions_of(*model->original, model->expansion.center);
    model->joined = joined_triangles(*model->original);
    model->base = values_of_shape(*model->original, model->expansion.center, is_gauge(*model));
  } else {
    model->directions = icosphere(subdivisions_for(coefficients.degree()));
    model->joined = model->directions.faces;
    model->base = evaluate(coefficients, model->directions.vertices, {}, context);
  }
  const bool radius = model->expansion.function == RadialFunction::kRadius;
  if (radius && model->expansion.norm_squared) model->beyond = rms_beyond(model->expansion);
  if (DegreeTable::fits(model->base.size(), coefficients.degree())) {
    model->table.emplace(coefficients, model->directions.vertices, model->base, context);
    if (model->original) model->max = largest_errors(*model);
  }
  return model;
}

Look whole(const Model& model) { return {.degree = model.expansion.coefficients.degree()}; }

std::vector<double> gains_of(const Look& look) {
  if (!look.gains.empty()) return look.gains;
  return std::vector<double>(look.degree + std::size_t{1}, 1.0);
}

Expansion expansion_of(const Model& model, const Look& look) {
  if (look == whole(model)) return model.expansion;
  // `rholm filter` uses the same name.
  const std::string name =
      look.gains.empty() ? "low-pass " + std::to_string(look.degree) + " ideal" : "own gains";
  return filter(model.expansion, gains_of(look), name);
}

Mesh surface_of(const Model& model, const Look& look, const Context& context) {
  if (!look.gains.empty()) return synthesize(expansion_of(model, look), model.directions, context);
  return std::move(
      synthesize(model.expansion, model.directions, std::span(&look.degree, 1), context).front());
}

QuickSurface quick_surface(const Model& model, const Look& look, const Context& context) {
  const std::vector<float> left = differences(model, look, context);
  const std::vector<Vec3>& u = model.directions.vertices;
  const Vec3& center = model.expansion.center;
  const bool gauge = is_gauge(model);
  QuickSurface surface;
  surface.positions.resize(3 * u.size());
  if (model.original) surface.error.resize(u.size());
  for (std::size_t j = 0; j < u.size(); ++j) {
    const double f = model.base[j] + double{left[j]};
    const double r = gauge ? 1 / f : f;
    float* x = &surface.positions[3 * j];
    x[0] = static_cast<float>(center.x + r * u[j].x);
    x[1] = static_cast<float>(center.y + r * u[j].y);
    x[2] = static_cast<float>(center.z + r * u[j].z);
    if (model.original) {
      surface.error[j] = gauge ? static_cast<float>(r - 1 / model.base[j]) : left[j];
    }
  }
  surface.normals = normals_of(surface.positions, model.directions.faces, model.joined);
  return surface;
}

}  // namespace rholm::studio
