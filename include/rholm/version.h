// The version, defined only here. Layer: base.
#pragma once

namespace rholm {

// Major, minor and patch: packages of the same minor version are compatible.
inline constexpr const char* kVersion = "0.3.0";

}  // namespace rholm
