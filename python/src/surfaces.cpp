// From an expansion to a mesh, its measures, distances between surfaces.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <utility>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/compare.h"
#include "rholm/descriptors.h"
#include "rholm/synthesize.h"

namespace rholm::python {

// A point that may be missing, as it is pickled and compared.
template <>
nb::object state_of(const std::optional<Vec3>& value) {
  return value ? state_of(*value) : nb::none();
}

// The definition of a descriptor, its unit and its source, as Python documents it.
std::string doc_of(const Descriptor& one) {
  std::string text = one.definition;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (*one.source != 0) text += std::string(" (") + one.source + ")";
  if (one.length_power == 1) text += ", in the unit of length";
  if (one.length_power > 1)
    text += ", in the unit of length to the power " + std::to_string(one.length_power);
  return text + ". None for a signed sum.";
}

void bind_surfaces(nb::module_& m) {
  m.def("synthesize", [](const Expansion& expansion, const Mesh& sphere,
                         const std::vector<int>& degrees, const Caller& caller) {
    std::vector<Mesh> meshes = caller.run(
        [&](const Context& context) { return synthesize(expansion, sphere, degrees, context); });
    nb::list result;
    for (Mesh& mesh : meshes) result.append(std::move(mesh));
    return result;
  });
  m.def("directions_of", unlocked_function(&directions_of));
  Record<SurfaceMeasures> measures(m, "SurfaceMeasures", "Of the solid bounded by a surface.");
  measures
      .hidden("volume", [](SurfaceMeasures& all) -> std::optional<double>& { return all.volume; })
      .hidden("area", [](SurfaceMeasures& all) -> std::optional<double>& { return all.area; })
      .hidden("centroid",
              [](SurfaceMeasures& all) -> std::optional<Vec3>& { return all.centroid; });
  for (const Descriptor& one : descriptors()) {
    measures.property(
        one.name, [value = one.value](const SurfaceMeasures& all) { return value(all); },
        doc_of(one).c_str());
  }
  measures.property(
      "centroid",
      [](const SurfaceMeasures& all) -> std::optional<ReadOnlyDoubles> {
        if (!all.centroid) return std::nullopt;
        return read_only(*all.centroid);
      },
      "Of the solid, (3,).");
  m.def("descriptors", [] {
    nb::list rows;
    for (const Descriptor& one : descriptors()) {
      nb::dict row;
      row["name"] = one.name;
      row["length_power"] = one.length_power;
      row["definition"] = one.definition;
      row["source"] = one.source;
      row["doc"] = doc_of(one);
      rows.append(row);
    }
    return rows;
  });
  m.def("measure", [](const Expansion& expansion, const Caller& caller) {
    return caller.run([&](const Context& context) { return measure(expansion, context); });
  });

  m.def("inertia", [](const Expansion& expansion, const Caller& caller) {
    const auto rows =
        caller.run([&](const Context& context) { return inertia(expansion, context); });
    return array_of(std::vector<Vec3>(rows.begin(), rows.end()));
  });

  Options<CompareOptions>(m, "CompareOptions", "Where distances are measured.")
      .field("samples", &CompareOptions::samples)
      .field("seed", &CompareOptions::seed)
      .field("threshold", &CompareOptions::threshold);
  Record<Distances>(m, "Distances", "Of all samples, in the shape's unit.")
      .field("rms", &Distances::rms, "Root mean square.")
      .field("mean", &Distances::mean, "Mean.")
      .field("max", &Distances::max, "Largest.");
  Record<Comparison>(m, "Comparison", "How far two surfaces lie apart, in the shape's unit.")
      .field("samples", &Comparison::samples, "On each surface.")
      .field("seed", &Comparison::seed, "They were drawn with.")
      .field("diagonal", &Comparison::diagonal, "Of the bounding box of a.")
      .field("a_to_b", &Comparison::a_to_b, "From samples of a to their closest points on b.")
      .field("b_to_a", &Comparison::b_to_a, "And the other way.")
      .field("hausdorff", &Comparison::hausdorff,
             "The larger of the two largest: a lower bound of the Hausdorff distance.")
      .field("threshold", &Comparison::threshold, "Of the F-score.")
      .field("precision", &Comparison::precision, "Share of b's samples within it of a.")
      .field("recall", &Comparison::recall, "Share of a's samples within it of b.")
      .field("f_score", &Comparison::f_score, "Harmonic mean of the two.")
      .field("normal_median_degrees", &Comparison::normal_median_degrees,
             "Median angle between normals, degrees.")
      .field("normal_mean_degrees", &Comparison::normal_mean_degrees,
             "Mean angle between normals, degrees.");
  m.def("compare", [](const Mesh& a, const Mesh& b, const CompareOptions& options,
                      const Caller& caller) {
    return caller.run([&](const Context& context) { return compare(a, b, options, context); });
  });
  m.def("distances_to_surface", [](const Rows& points, const Mesh& surface, const Caller& caller) {
    const std::vector<Vec3> at = vector_of(points);
    return array_of(caller.run(
        [&](const Context& context) { return distances_to_surface(at, surface, context); }));
  });
}

}  // namespace rholm::python
