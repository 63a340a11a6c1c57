// Samples of surfaces; cleaning, alignment and normals of points.
#include "rholm/points.h"

#include <utility>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"

namespace rholm::python {

void bind_points(nb::module_& m) {
  Options<SampleOptions>(m, "SampleOptions", "What is measured of a surface.").fields();
  m.def("sample_surface", [](const Mesh& mesh, const SampleOptions& options, const Caller& caller) {
    return caller.run(
        [&](const Context& context) { return sample_surface(mesh, options, context); });
  });

  Record<CleanReport>(m, "CleanReport", "What clean() found.").fields();
  m.def("clean", [](PointCloud cloud, const Caller& caller) {
    const CleanReport report =
        caller.run([&](const Context& context) { return clean(cloud, context); });
    return nb::make_tuple(std::move(cloud), report);
  });

  Record<ScanAlignment>(m, "ScanAlignment",
                        "What align_scans() did; lengths are in the unit of the points.")
      .fields();
  m.def("align_scans", [](PointCloud cloud, const Caller& caller) {
    const ScanAlignment report =
        caller.run([&](const Context& context) { return align_scans(cloud, context); });
    return nb::make_tuple(std::move(cloud), report);
  });

  Options<OrientOptions>(m, "OrientOptions", "How normals are found and which side is outside.")
      .fields();
  Record<OrientReport>(m, "OrientReport", "What orient() did, and how sure it is.").fields();
  m.def("orient", [](PointCloud cloud, const OrientOptions& options, const Caller& caller) {
    const OrientReport report =
        caller.run([&](const Context& context) { return orient(cloud, options, context); });
    return nb::make_tuple(std::move(cloud), report);
  });
}

}  // namespace rholm::python
