#include "model/encode/by_chart.h"

#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "model/encode/encoded_parts.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "shape/repair/thin_faces.h"

namespace rholm {
namespace {

struct Topology {
  Outward shape;
  std::vector<Edge> edges;
};

Topology topology_of(const Mesh& mesh, double weld_tolerance) {
  Topology topology;
  topology.shape = outward(mesh, weld_tolerance);
  topology.shape.welded.mesh.attributes.clear();
  // Their planes would say as much as those of others about slopes and errors.
  swap_thin_faces(topology.shape.welded.mesh);
  topology.edges = pair_edges(topology.shape.welded.mesh);
  return topology;
}

// Says that the mesh was turned even where it is refused afterwards.
StarChart chart_of(Topology& topology, const ChartOptions& options, const Context& context) {
  try {
    return make_star_chart(topology.shape.welded.mesh, std::move(topology.edges), options, context);
  } catch (const Error& error) {
    const bool is_of_mesh =
        error.code() == ErrorCode::kInvalidInput || error.code() == ErrorCode::kNotStarShaped;
    if (!topology.shape.flipped || !is_of_mesh) throw;
    throw Error(error.code(), std::string("the mesh was inside out and has been turned right side "
                                          "out; then: ") +
                                  error.what());
  }
}

void transform(const StarChart& chart, const EncodeOptions& options, const Context& context,
               Encoded& encoded) {
  if (options.tolerance) {
    set_found(analyze(chart, *options.tolerance, options.analyze, context), options, encoded);
  } else {
    encoded.analysis = analyze(chart, options.analyze, context);
  }
}

}  // namespace

Encoded encode_by_chart(const Mesh& mesh, const EncodeOptions& options, const Context& context) {
  Encoded encoded;
  encoded.diagonal = bounds(mesh.vertices).diagonal();
  report_progress(context, "topology", 0);
  Topology topology =
      timed(encoded.times, "topology", [&] { return topology_of(mesh, options.weld_tolerance); });
  report_progress(context, "center", 0);
  const StarChart chart =
      timed(encoded.times, "center", [&] { return chart_of(topology, options.chart, context); });
  encoded.star = chart.report;
  encoded.vertices = chart.mesh.vertices.size();
  encoded.faces = chart.mesh.triangles.size();
  encoded.edges = chart.edges.size();
  encoded.merged_vertices = topology.shape.welded.merged_vertices;
  encoded.collapsed_triangles = topology.shape.welded.collapsed_triangles;
  encoded.flipped = topology.shape.flipped;
  timed(encoded.times, "transform", [&] { transform(chart, options, context, encoded); });
  if (chart.report.star_shaped) {
    ErrorSites sites(view_of(topology.shape.welded.mesh), encoded.analysis.expansion.center,
                     context.threads);
    add_errors(sites, true, options, context, encoded);
  }
  return encoded;
}

}  // namespace rholm
