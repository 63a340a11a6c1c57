#include <fmt/format.h>

#include <utility>

#include "chart/center/view_center.h"
#include "rholm/error.h"
#include "rholm/star.h"

namespace rholm {
namespace {

std::string describe(const StarReport& report, double diagonal) {
  std::string text = fmt::format(
      "from the centre ({:.9g}, {:.9g}, {:.9g}) the smallest distance to the plane of a "
      "face, min d, is {:.3g} ({:.2g} of the diagonal), "
      "min cos gamma {:.3g}, and {} faces turn their backs",
      report.center.x, report.center.y, report.center.z, report.min_d, report.min_d / diagonal,
      report.min_cos_gamma, report.bad_faces);
  if (report.rays > 0) {
    text +=
        fmt::format("; {:.3g} % of {} directions meet the surface more than once, {:.3g} % never",
                    100 * report.multiple_share, report.rays, 100 * report.missed_share);
  }
  return text;
}

void refuse(const Mesh& mesh, const StarReport& report, bool allow_signed) {
  if (const double volume = enclosed_volume(mesh); volume < 0) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("the mesh is inside out (its volume is {:.6g}): 'rholm repair' turns it",
                    volume));
  }
  if (allow_signed) return;
  const Inspection shape = inspect(mesh);
  if (shape.duplicate_faces > 0) {
    throw Error(
        ErrorCode::kNotStarShaped,
        fmt::format("the surface is not star-shaped: {} of its {} faces are duplicates, with "
                    "the same three vertices as others, and directions meet it twice; "
                    "'rholm repair' drops them",
                    shape.duplicate_faces, shape.faces));
  }
  std::string why = "the surface is not star-shaped";
  if (shape.components > 1) {
    why += fmt::format(" (it has {} components that are not connected)", shape.components);
  }
  throw Error(ErrorCode::kNotStarShaped,
              why + ": " + describe(report, shape.bounds.diagonal()) +
                  (report.center_fell_back ? "" : "; let the centre be found") +
                  "; 'rholm compress' makes an atlas of caps, which takes any shape");
}

}  // namespace

StarReport seen_surface(const Mesh& mesh, const ChartOptions& options, const Context& context) {
  StarReport report = find_center(mesh, options.center, context);
  if (report.star_shaped) {
    report.rays = 0;  // whatever number was tried: all directions meet the surface once
  } else {
    refuse(mesh, report, options.allow_signed);
  }
  return report;
}

StarChart make_star_chart(const Mesh& mesh, const ChartOptions& options, const Context& context) {
  validate(mesh);
  return make_star_chart(mesh, pair_edges(mesh), options, context);
}

StarChart make_star_chart(const Mesh& mesh, std::vector<Edge> edges, const ChartOptions& options,
                          const Context& context) {
  StarChart chart;
  chart.edges = std::move(edges);
  chart.report = seen_surface(mesh, options, context);
  chart.mesh.faces = mesh.faces;
  chart.mesh.vertices.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) chart.mesh.vertices.push_back(v - chart.report.center);
  return chart;
}

}  // namespace rholm
