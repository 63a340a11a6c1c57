#include <time.h>

#include <chrono>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/model.h"

namespace rholm {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Runs a stage and notes its times.
template <typename Stage>
auto timed(StageTime& time, const Stage& stage) {
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  auto result = stage();
  time.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  time.cpu += cpu_seconds() - cpu;
  return result;
}

struct Topology {
  Welded welded;
  std::vector<Edge> edges;
  bool flipped = false;
};

Topology topology_of(const Mesh& mesh, double weld_tolerance) {
  validate(mesh);
  Topology topology;
  topology.welded = weld(mesh, weld_tolerance);
  topology.welded.mesh.attributes.clear();
  if (enclosed_volume(topology.welded.mesh) < 0) {
    flip(topology.welded.mesh);
    topology.flipped = true;
  }
  topology.edges = pair_edges(topology.welded.mesh);
  return topology;
}

// Says that the mesh was turned even where it is refused afterwards.
StarChart chart_of(Topology& topology, const ChartOptions& options, const Context& context) {
  try {
    return make_star_chart(topology.welded.mesh, std::move(topology.edges), options, context);
  } catch (const Error& error) {
    if (!topology.flipped || error.code() == ErrorCode::kCancelled) throw;
    throw Error(error.code(), std::string("the mesh was inside out and has been turned right side "
                                          "out; then: ") +
                                  error.what());
  }
}

}  // namespace

Encoded encode(const Mesh& mesh, const EncodeOptions& options, const Context& context) {
  Encoded encoded;
  report_progress(context, "topology", 0);
  Topology topology =
      timed(encoded.times["topology"], [&] { return topology_of(mesh, options.weld_tolerance); });
  report_progress(context, "center", 0);
  const StarChart chart =
      timed(encoded.times["center"], [&] { return chart_of(topology, options.chart, context); });
  encoded.star = chart.report;
  encoded.vertices = chart.mesh.vertices.size();
  encoded.faces = chart.mesh.triangles.size();
  encoded.edges = chart.edges.size();
  encoded.merged_vertices = topology.welded.merged_vertices;
  encoded.collapsed_triangles = topology.welded.collapsed_triangles;
  encoded.flipped = topology.flipped;
  encoded.analysis =
      timed(encoded.times["transform"], [&] { return analyze(chart, options.analyze, context); });
  return encoded;
}

}  // namespace rholm
