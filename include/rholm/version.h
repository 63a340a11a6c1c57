// The version, which stands here and nowhere else. Layer: base.
#pragma once

namespace rholm {

inline constexpr const char* kVersion = "0.2.0";

}  // namespace rholm
