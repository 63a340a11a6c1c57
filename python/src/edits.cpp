// Local smoothing and transfer of detail: analyses and updates.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/error.h"
#include "rholm/region.h"
#include "rholm/smooth.h"
#include "rholm/transfer.h"

namespace rholm::python {
namespace {

std::vector<Region> regions_of(const std::vector<std::string>& texts) {
  std::vector<Region> regions;
  regions.reserve(texts.size());
  for (const std::string& text : texts) regions.push_back(parse_region(text));
  return regions;
}

void bind_smooth(nb::module_& m) {
  m.def("region_weights",
        [](const Mesh& mesh, const std::vector<std::string>& regions, double transition) {
          return array_of(
              unlocked([&] { return region_weights(mesh, regions_of(regions), transition); }));
        });
  Options<PatchOptions>(m, "PatchOptions", "What is to go from a region.").fields();
  nb::class_<Patch> patch_type(m, "Patch", "The vertices that may move, and where fits want them.");
  bind_state(
      patch_type,
      [](const Patch& p) {
        return nb::make_tuple(p.wavelength, p.degree, array_of(std::vector(p.vertices)),
                              array_of(std::vector(p.positions)), array_of(p.weights),
                              array_of(std::vector(p.moves)), p.caps, p.unreached);
      },
      [](const nb::object& state) {
        const auto parts = nb::cast<nb::tuple>(state);
        const auto vertices =
            nb::cast<nb::ndarray<const std::uint32_t, nb::ndim<1>, nb::c_contig>>(parts[2]);
        Patch p;
        p.wavelength = nb::cast<double>(parts[0]);
        p.degree = nb::cast<int>(parts[1]);
        p.vertices.assign(vertices.data(), vertices.data() + vertices.size());
        p.positions = vector_of(nb::cast<Rows>(parts[3]));
        p.weights = vector_of(nb::cast<Doubles>(parts[4]));
        p.moves = vector_of(nb::cast<Rows>(parts[5]));
        p.caps = nb::cast<std::size_t>(parts[6]);
        p.unreached = nb::cast<std::size_t>(parts[7]);
        return p;
      });
  patch_type.def_ro("wavelength", &Patch::wavelength)
      .def_ro("degree", &Patch::degree)
      .def_ro("caps", &Patch::caps)
      .def_ro("unreached", &Patch::unreached)
      .def_prop_ro(
          "vertices",
          [](const Patch& p) { return array_of(std::vector<std::uint32_t>(p.vertices)); },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "positions", [](const Patch& p) { return array_of(std::vector<Vec3>(p.positions)); },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "weights", [](const Patch& p) { return array_of(p.weights); }, nb::rv_policy::automatic);
  m.def("analyze_patch", [](const Mesh& mesh, const std::vector<std::string>& regions,
                            const PatchOptions& options, const Caller& caller) {
    const std::vector<Region> where = regions_of(regions);
    return caller.run(
        [&](const Context& context) { return analyze_patch(mesh, where, options, context); });
  });
  m.def("longest_wavelength", &longest_wavelength);
  m.def("update_patch", [](const Patch& patch, double wavelength, double strength) {
    return array_of(unlocked([&] { return update(patch, PatchUpdate{wavelength, strength}); }));
  });
  m.def("apply", [](const Patch& patch, const Rows& positions, Mesh mesh) {
    if (positions.shape(0) != patch.vertices.size()) {
      throw Error(ErrorCode::kInvalidInput, std::to_string(positions.shape(0)) + " positions for " +
                                                std::to_string(patch.vertices.size()) +
                                                " vertices of the patch");
    }
    for (const std::uint32_t v : patch.vertices) {
      if (v >= mesh.vertices.size()) {
        throw Error(ErrorCode::kInvalidInput, "the patch is of another mesh");
      }
    }
    apply(patch, span_of(positions), mesh);
    return mesh;
  });
  // Changes the mesh of an editor in place: arrays over its vertices show the change.
  m.def("apply_in_place", [](const Patch& patch, double wavelength, double strength, Mesh& mesh) {
    apply(patch, update(patch, PatchUpdate{wavelength, strength}), mesh);
  });
  m.def("copy_mesh", [](const Mesh& mesh) { return mesh; });
}

void bind_transfer(nb::module_& m) {
  Options<TransferOptions>(m, "TransferOptions", "What counts as detail, and how large it is laid.")
      .fields();
  Options<TransferUpdate>(m, "TransferUpdate", "What a slider moves.").fields();
  Record<TransferReport>(m, "TransferReport",
                         "What the analysis found; lengths are in the units of the two meshes.")
      .fields();
  nb::class_<TransferSource>(m, "TransferSource", "A texture taken from its source.")
      .def_ro("from_degree", &TransferSource::from_degree)
      .def_ro("radius", &TransferSource::radius)
      .def_ro("wavelength", &TransferSource::wavelength)
      .def_ro("edge", &TransferSource::edge)
      .def_ro("rms", &TransferSource::rms);
  nb::class_<TransferAnalysis>(m, "TransferAnalysis", "What an analysis knows.")
      .def_prop_ro("mesh", [](const TransferAnalysis& a) { return a.mesh; })
      .def_prop_ro("patch", [](const TransferAnalysis& a) { return a.patch; })
      .def_ro("report", &TransferAnalysis::report);
  m.def("analyze_source", [](const Mesh& source, const std::vector<std::string>& from,
                             int from_degree, const Caller& caller) {
    const std::vector<Region> taken = regions_of(from);
    return caller.run([&](const Context& context) {
      return analyze_source(source, taken, from_degree, context);
    });
  });
  m.def("analyze_transfer",
        [](const TransferSource& source, const Mesh& target, const std::vector<std::string>& to,
           const TransferOptions& options, const Caller& caller) {
          const std::vector<Region> laid = regions_of(to);
          return caller.run([&](const Context& context) {
            return analyze_transfer(source, target, laid, options, context);
          });
        });
  m.def("update_transfer",
        [](const TransferAnalysis& analysis, const TransferUpdate& wanted, const Caller& caller) {
          return array_of(caller.run([&](const Context&) { return update(analysis, wanted); }));
        });
  m.def(
      "apply_transfer_in_place", [](const TransferAnalysis& analysis, const TransferUpdate& wanted,
                                    Mesh& mesh, const Caller& caller) {
        caller.run([&](const Context&) { apply(analysis.patch, update(analysis, wanted), mesh); });
      });
}

}  // namespace

void bind_edits(nb::module_& m) {
  bind_smooth(m);
  bind_transfer(m);
}

}  // namespace rholm::python
