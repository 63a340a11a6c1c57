// Points made from meshes, put in order, given normals.
#include "rholm/points.h"

#include <utility>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"

namespace rholm::python {

void bind_points(nb::module_& m) {
  Options<SampleOptions>(m, "SampleOptions", "What is measured of a surface.")
      .field("points", &SampleOptions::points)
      .field("noise", &SampleOptions::noise)
      .field("normal_noise", &SampleOptions::normal_noise)
      .field("outliers", &SampleOptions::outliers)
      .field("holes", &SampleOptions::holes)
      .field("hole_radius", &SampleOptions::hole_radius)
      .field("density_ratio", &SampleOptions::density_ratio)
      .choice("pattern", &SampleOptions::pattern, parse_sample_pattern, to_string)
      .field("pattern_ratio", &SampleOptions::pattern_ratio)
      .field("pattern_axis", &SampleOptions::pattern_axis)
      .field("scans", &SampleOptions::scans)
      .field("misalignment", &SampleOptions::misalignment)
      .field("scan_noise", &SampleOptions::scan_noise)
      .field("sensor", &SampleOptions::sensor)
      .field("normals", &SampleOptions::normals)
      .field("seed", &SampleOptions::seed);
  m.def("sample_surface", [](const Mesh& mesh, const SampleOptions& options, const Caller& caller) {
    return caller.run(
        [&](const Context& context) { return sample_surface(mesh, options, context); });
  });

  Record<CleanReport>(m, "CleanReport", "What clean() found.")
      .field("points", &CleanReport::points, "Number of points before.")
      .field("not_finite", &CleanReport::not_finite,
             "Points dropped: a coordinate was NaN or infinite.")
      .field("duplicates", &CleanReport::duplicates,
             "Points dropped: at the place of an earlier one.")
      .field("opposite_normals", &CleanReport::opposite_normals,
             "Of these, with a normal against the earlier one's.")
      .field("zero_normals", &CleanReport::zero_normals,
             "Of the points that stay, those with a zero normal.");
  m.def("clean", [](PointCloud cloud, const Caller& caller) {
    const CleanReport report =
        caller.run([&](const Context& context) { return clean(cloud, context); });
    return nb::make_tuple(std::move(cloud), report);
  });

  Record<ScanAlignment>(m, "ScanAlignment",
                        "What align_scans() did; lengths are in the unit of the points.")
      .field("scans", &ScanAlignment::scans, "Different values of the attribute; 0 without one.")
      .field("pairs", &ScanAlignment::pairs,
             "Points of one scan that were compared with those of another.")
      .field("distance_before", &ScanAlignment::distance_before,
             "Of these pairs along the normal, as a standard deviation, before anything moved.")
      .field("distance", &ScanAlignment::distance, "The same after.")
      .field("moved", &ScanAlignment::moved, "Root mean square way of all points.");
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
