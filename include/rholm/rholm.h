// rholm: spherical harmonics of 3D objects. The whole public interface, and its version.
// Layer: report.
#pragma once

#include "rholm/analyze.h"
#include "rholm/bench.h"
#include "rholm/coefficients.h"
#include "rholm/coefficients_io.h"
#include "rholm/compare.h"
#include "rholm/context.h"
#include "rholm/error.h"
#include "rholm/file.h"
#include "rholm/harmonic.h"
#include "rholm/image.h"
#include "rholm/mapped_mesh.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"
#include "rholm/model.h"
#include "rholm/monte_carlo.h"
#include "rholm/primitives.h"
#include "rholm/render.h"
#include "rholm/report.h"
#include "rholm/shape_io.h"
#include "rholm/star.h"
#include "rholm/synthesize.h"
#include "rholm/topology.h"
#include "rholm/truncation.h"
#include "rholm/vec3.h"

namespace rholm {

inline constexpr const char* kVersion = "0.1.0";

}  // namespace rholm
