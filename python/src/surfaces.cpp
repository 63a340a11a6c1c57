// From an expansion to a mesh, its measures, and distances between surfaces.
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

// Converts an optional point for pickling and comparison.
template <>
nb::object state_of(const std::optional<Vec3>& value) {
  return value ? state_of(*value) : nb::none();
}

// Returns the docstring of a descriptor: its definition, unit and source.
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

  Options<CompareOptions>(m, "CompareOptions", "Where distances are measured.").fields();
  Record<Distances>(m, "Distances", "Of all samples, in the shape's unit.").fields();
  Record<Comparison>(m, "Comparison", "How far two surfaces lie apart, in the shape's unit.")
      .fields();
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
