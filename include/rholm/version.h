// The version, which stands here and nowhere else. Layer: base.
#pragma once

namespace rholm {

// Major, minor and patch: packages of one minor version fit each other.
inline constexpr const char* kVersion = "0.2.0";

}  // namespace rholm
