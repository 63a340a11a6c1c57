#include <string>

#include "rholm/error.h"
#include "rholm/surface_rules.h"

namespace rholm {

const char* to_string(HolePolicy policy) { return policy == HolePolicy::kFill ? "fill" : "keep"; }

HolePolicy parse_hole_policy(const std::string& name) {
  for (const HolePolicy policy : {HolePolicy::kFill, HolePolicy::kKeep}) {
    if (name == to_string(policy)) return policy;
  }
  throw Error(ErrorCode::kInvalidInput, "unknown way with holes '" + name + "': fill or keep");
}

}  // namespace rholm
