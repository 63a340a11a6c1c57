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

struct NamedKind {
  std::string_view name;
  CenterKind kind;
};
constexpr NamedKind kNamedKinds[] = {{"auto", CenterKind::kAuto},
                                     {"cosine", CenterKind::kCosine},
                                     {"none", CenterKind::kNone},
                                     {"centroid", CenterKind::kCentroid},
                                     {"volume", CenterKind::kVolume}};

// Three finite numbers with commas between them; false if the text is something else.
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
  for (const NamedKind& named : kNamedKinds) {
    if (text == named.name) {
      options.kind = named.kind;
      return options;
    }
  }
  options.kind = CenterKind::kGiven;
  if (!parse_point(text, options.point)) {
    throw Error(ErrorCode::kInvalidInput,
                "the centre '" + text +
                    "' is not auto, cosine, none, centroid, volume or three numbers X,Y,Z");
  }
  return options;
}

const char* to_string(CenterKind kind) {
  for (const NamedKind& named : kNamedKinds) {
    if (named.kind == kind) return named.name.data();
  }
  return "given";
}

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
      validate(view.mesh);
      return {.point = volume_centroid(view.mesh, view.frame, context)};
    case CenterKind::kAuto:
    case CenterKind::kCosine:
      break;
  }
  KernelCenter kernel = chebyshev_center(view, context);
  const bool empty = !(kernel.value > 0);
  if (options.kind == CenterKind::kCosine && !empty) {
    kernel = cosine_center(view, kernel.point, context);
  }
  return {.point = view.frame.to_shape(kernel.point), .kernel_empty = empty, .scans = kernel.scans};
}

// Which of the two sees more directions once; without rays, which has fewer triangles turned away.
StarReport better_center(const LocalView& view, const StarReport& program, int rays,
                         const Context& context) {
  const FoundCenter found = search_center(view, {.kind = CenterKind::kVolume}, context);
  const StarReport volume = check_star(view, found.point, rays, context);
  const bool volume_is_better = rays > 0 ? volume.once_share > program.once_share
                                         : volume.bad_triangles < program.bad_triangles;
  StarReport better = volume_is_better ? volume : program;
  better.center_fell_back = true;
  return better;
}

StarReport find_center(const MeshView& mesh, const CenterOptions& options, const Context& context) {
  const LocalView view = local_view(mesh, context);
  const FoundCenter found = search_center(view, options, context);
  const StarReport report = check_star(view, found.point, options.rays, context);
  const bool may_fall_back =
      options.kind == CenterKind::kAuto || options.kind == CenterKind::kCosine;
  if (report.star_shaped || !may_fall_back) return report;
  return better_center(view, report, options.rays, context);
}

StarReport find_center(const Mesh& mesh, const CenterOptions& options, const Context& context) {
  return find_center(view_of(mesh), options, context);
}

}  // namespace rholm
