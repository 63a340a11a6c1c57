#include "rholm/atlas.h"

namespace rholm {

std::size_t n_coefficients(CapBasis basis, int degree) {
  const auto l = static_cast<std::size_t>(degree);
  return basis == CapBasis::kFull ? (l + 1) * (l + 1) : (l + 1) * (l + 2) / 2;
}

}  // namespace rholm
