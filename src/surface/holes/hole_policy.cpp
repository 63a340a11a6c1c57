#include <array>

#include "rholm/surface_rules.h"

namespace rholm {

EnumNames names_of(HolePolicy) {
  static constexpr std::array kNames = {"fill", "keep"};
  return {"hole policy", kNames};
}

}  // namespace rholm
