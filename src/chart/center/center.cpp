#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "chart/center/kernel.h"
#include "chart/center/view_center.h"
#include "rholm/error.h"
#include "rholm/star.h"
#include "shape/measure.h"

namespace rholm {
namespace {

constexpr const char* kKinds[] = {"auto", "kernel",   "slope",  "cosine",
                                  "none", "centroid", "volume", "given"};

// Parses three finite numbers separated by commas; returns false for any other text.
bool parse_point(std::string_view text, Vec3& point) {
  double* const parts[3] = {&point.x, &point.y, &point.z};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int k = 0; k < 3; ++k) {
    if (k > 0) {
      if (at == end || *at != ',') return false;
      ++at;
    }
    while (at != end && *at == ' ') ++at;
    if (end - at > 1 && at[0] == '+' && at[1] != '-') ++at;
    const auto [next, error] = std::from_chars(at, end, *parts[k]);
    if (error != std::errc()) return false;
    at = next;
  }
  return at == end && is_finite(point);
}

}  // namespace

CenterOptions parse_center(const std::string& text) {
  CenterOptions options;
  for (int kind = 0; kind < static_cast<int>(CenterKind::kGiven); ++kind) {
    if (text == kKinds[kind]) {
      options.kind = static_cast<CenterKind>(kind);
      return options;
    }
  }
  options.kind = CenterKind::kGiven;
  if (!parse_point(text, options.point)) {
    throw Error(
        ErrorCode::kInvalidInput,
        "the centre '" + text +
            "' is not auto, kernel, slope, cosine, none, centroid, volume or three numbers X,Y,Z");
  }
  return options;
}

EnumNames names_of(CenterKind) { return {"kind of centre", kKinds}; }

namespace {

bool seeks_slope(CenterKind kind) {
  return kind == CenterKind::kAuto || kind == CenterKind::kSlope;
}

bool seeks_kernel(CenterKind kind) {
  return seeks_slope(kind) || kind == CenterKind::kKernel || kind == CenterKind::kCosine;
}

// Returns the point with the least slope of the radius, at a distance from the kernel's border.
FoundCenter slope_center(const LocalView& view, const KernelCenter& kernel,
                         const Context& context) {
  // Chosen, far above rounding. If the kernel is smaller than kSmallestKernel (in the unit frame),
  // only its middle is safely inside it. A centroid nearer to the middle than kSame defines no
  // line.
  constexpr double kSmallestKernel = 1e-6, kSame = 1e-12;
  const Vec3 centroid = view.frame.to_local(volume_centroid(view.mesh, view.frame, context));
  Vec3 point = kernel.point;
  if (kernel.value > kSmallestKernel && norm(centroid - point) > kSame) {
    point = least_slope(view, kernel, centroid, context);
  }
  return {.point = view.frame.to_shape(point), .scans = kernel.scans + 2};
}

// Returns the centroid if every face is front-facing from it, or if the kernel is empty. Otherwise
// returns the point of least slope.
FoundCenter volume_center(const LocalView& view, const Context& context) {
  validate(view.mesh);
  const FoundCenter centroid = {.point = volume_centroid(view.mesh, view.frame, context)};
  if (check_star(view, centroid.point, 0, context).bad_faces == 0) return centroid;
  const KernelCenter kernel = chebyshev_center(view, context);
  return kernel.value > 0 ? slope_center(view, kernel, context) : centroid;
}

}  // namespace

FoundCenter search_center(const LocalView& view, const CenterOptions& options,
                          const Context& context) {
  switch (options.kind) {
    case CenterKind::kNone:
      return {};
    case CenterKind::kGiven:
      return {.point = options.point};
    case CenterKind::kCentroid:
      validate(view.mesh);
      return {.point = measure(view.mesh, view.frame).area_centroid};
    case CenterKind::kVolume:
      return volume_center(view, context);
    case CenterKind::kAuto:
    case CenterKind::kKernel:
    case CenterKind::kSlope:
    case CenterKind::kCosine:
      break;
  }
  KernelCenter kernel = chebyshev_center(view, context);
  const bool empty = !(kernel.value > 0);
  if (seeks_slope(options.kind) && !empty) return slope_center(view, kernel, context);
  if (options.kind == CenterKind::kCosine && !empty) {
    kernel = cosine_center(view, kernel.point, context);
  }
  return {.point = view.frame.to_shape(kernel.point), .kernel_empty = empty, .scans = kernel.scans};
}

// Returns the report with more directions seen once; without rays, the one with fewer back faces.
StarReport better_center(const LocalView& view, const StarReport& program, int rays,
                         const Context& context) {
  const StarReport volume =
      check_star(view, volume_centroid(view.mesh, view.frame, context), rays, context);
  const bool volume_is_better =
      rays > 0 ? volume.once_share > program.once_share : volume.bad_faces < program.bad_faces;
  StarReport better = volume_is_better ? volume : program;
  better.center_fell_back = true;
  return better;
}

StarReport find_center(const MeshView& mesh, const CenterOptions& options, const Context& context) {
  const LocalView view = local_view(mesh, context);
  const FoundCenter found = search_center(view, options, context);
  const StarReport report = check_star(view, found.point, options.rays, context);
  if (report.star_shaped || !seeks_kernel(options.kind)) return report;
  if (seeks_slope(options.kind) && !found.kernel_empty) {
    // Rounding may turn planes: the middle of the kernel is the safest point.
    return find_center(mesh, {.kind = CenterKind::kKernel, .point = {}, .rays = options.rays},
                       context);
  }
  return better_center(view, report, options.rays, context);
}

StarReport find_center(const Mesh& mesh, const CenterOptions& options, const Context& context) {
  return find_center(view_of(mesh), options, context);
}

}  // namespace rholm
