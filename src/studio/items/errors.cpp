#include "studio/items/errors.h"

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

}  // namespace rholm::studio
