// A cap's frame in the form that kernels use. Layer: atlas.
#pragma once

#include "rholm/cap_frame.h"

namespace rholm {

// Frame in the kernel's type and unit of length, without the seed, which is its origin.
template <class T>
struct LaneFrame {
  T x[3], y[3], z[3];
  T radius, dilation;
};

template <class T>
LaneFrame<T> lane_frame(const CapFrame& frame, double unit = 1) {
  const auto to = [](double value) { return static_cast<T>(value); };
  return {{to(frame.x.x), to(frame.x.y), to(frame.x.z)},
          {to(frame.y.x), to(frame.y.y), to(frame.y.z)},
          {to(frame.z.x), to(frame.z.y), to(frame.z.z)},
          to(frame.radius / unit),
          to(frame.dilation)};
}

}  // namespace rholm
