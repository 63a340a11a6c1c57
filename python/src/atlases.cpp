// Atlases of caps: compression, surfaces, the paper's atlas, files.
#include "rholm/atlas.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/patch_atlas.h"

namespace rholm::python {
namespace {

using Shape = std::variant<const Mesh*, const PointCloud*>;

// Numbers per cap in the pickled array of an atlas, which may have thousands of caps.
constexpr std::size_t kCapNumbers = 27;

std::array<double, kCapNumbers> numbers_of(const Cap& c) {
  const CapFrame& f = c.frame;
  return {f.center.x,
          f.center.y,
          f.center.z,
          f.x.x,
          f.x.y,
          f.x.z,
          f.y.x,
          f.y.y,
          f.y.z,
          f.z.x,
          f.z.y,
          f.z.z,
          f.radius,
          f.dilation,
          f.support,
          c.where.px,
          c.where.py,
          c.where.xx,
          c.where.xy,
          c.where.yy,
          static_cast<double>(c.basis),
          static_cast<double>(c.degree),
          static_cast<double>(c.first),
          c.error,
          c.area,
          c.weight,
          c.deviation};
}

Cap cap_of(const double* n) {
  const auto row = [&](int i) { return Vec3{n[i], n[i + 1], n[i + 2]}; };
  Cap cap;
  cap.frame = {row(0), row(3), row(6), row(9), n[12], n[13], n[14]};
  cap.where = {n[15], n[16], n[17], n[18], n[19]};
  cap.basis = n[20] == 0 ? CapBasis::kFull : CapBasis::kEven;
  cap.degree = static_cast<std::uint16_t>(n[21]);
  cap.first = static_cast<std::size_t>(n[22]);
  cap.error = n[23], cap.area = n[24], cap.weight = n[25], cap.deviation = n[26];
  return cap;
}

nb::object state_of_atlas(const Atlas& atlas) {
  std::vector<double> caps;
  caps.reserve(kCapNumbers * atlas.caps.size());
  for (const Cap& cap : atlas.caps) {
    const auto numbers = numbers_of(cap);
    caps.insert(caps.end(), numbers.begin(), numbers.end());
  }
  return nb::make_tuple(array_of(std::move(caps)), array_of(atlas.coefficients),
                        to_string(atlas.blend), atlas.spacing, atlas.noise, atlas.diagonal,
                        atlas.band);
}

Atlas atlas_of_state(const nb::object& state) {
  const auto [caps, coefficients, blend, spacing, noise, diagonal, band] =
      nb::cast<std::tuple<Doubles, Doubles, std::string, double, double, double, double>>(state);
  Atlas atlas;
  for (std::size_t i = 0; i + kCapNumbers <= caps.size(); i += kCapNumbers) {
    const Cap cap = cap_of(caps.data() + i);
    const std::size_t n = n_coefficients(cap.basis, cap.degree);
    if (cap.first > coefficients.size() || n > coefficients.size() - cap.first) {
      throw Error(ErrorCode::kInvalidInput, "a cap of the pickled atlas has no coefficients");
    }
    atlas.caps.push_back(cap);
  }
  atlas.coefficients = vector_of(coefficients);
  atlas.blend = parse_name<CapBlend>(blend);
  atlas.spacing = spacing, atlas.noise = noise, atlas.diagonal = diagonal, atlas.band = band;
  return atlas;
}

void bind_caps(nb::module_& m) {
  Record<Cap>(m, "Cap", "One cap of an atlas.")
      .property(
          "center", [](const Cap& c) { return read_only(c.frame.center); },
          "Centre of the cap's sphere, in the coordinates of the shape, (3,).")
      .property(
          "axes",
          [](const Cap& c) {
            return read_only(std::vector<Vec3>{c.frame.x, c.frame.y, c.frame.z});
          },
          "Axes of the cap's frame, rows x, y, z; z points outwards, (3, 3).")
      .property(
          "radius", [](const Cap& c) { return c.frame.radius; }, "Radius of the cap's sphere.")
      .property(
          "dilation", [](const Cap& c) { return c.frame.dilation; },
          "Dilation a of the cap: tan(theta'/2) = a tan(theta/2).")
      .property(
          "support", [](const Cap& c) { return c.frame.support; },
          "Radius of the points around the seed that the cap was fitted to.")
      .property(
          "seed", [](const Cap& c) { return read_only(c.frame.seed()); },
          "Point of the cap's sphere in the middle of the cap, (3,).")
      .property(
          "ellipse",
          [](const Cap& c) {
            return nb::make_tuple(c.where.px, c.where.py, c.where.xx, c.where.xy, c.where.yy);
          },
          "Ellipse of the cap's support: centre (px, py) and quadratic form (xx, xy, yy).")
      .fields()
      .hidden("frame_center", [](Cap& c) -> Vec3& { return c.frame.center; })
      .hidden("frame_x", [](Cap& c) -> Vec3& { return c.frame.x; })
      .hidden("frame_y", [](Cap& c) -> Vec3& { return c.frame.y; })
      .hidden("frame_z", [](Cap& c) -> Vec3& { return c.frame.z; })
      .hidden("radius", [](Cap& c) -> double& { return c.frame.radius; })
      .hidden("dilation", [](Cap& c) -> double& { return c.frame.dilation; })
      .hidden("support", [](Cap& c) -> double& { return c.frame.support; })
      .hidden("px", [](Cap& c) -> double& { return c.where.px; })
      .hidden("py", [](Cap& c) -> double& { return c.where.py; })
      .hidden("xx", [](Cap& c) -> double& { return c.where.xx; })
      .hidden("xy", [](Cap& c) -> double& { return c.where.xy; })
      .hidden("yy", [](Cap& c) -> double& { return c.where.yy; });
  nb::class_<Atlas> atlas_type(m, "Atlas", "A surface of any genus as overlapping caps.");
  bind_state(atlas_type, &state_of_atlas, &atlas_of_state);
  atlas_type.def_prop_ro("n_caps", [](const Atlas& atlas) { return atlas.caps.size(); })
      .def("cap",
           [](const Atlas& atlas, std::size_t i) {
             if (i >= atlas.caps.size()) throw nb::index_error("no such cap");
             return atlas.caps[i];
           })
      .def("coefficients_of",
           [](const Atlas& atlas, std::size_t i) {
             if (i >= atlas.caps.size()) throw nb::index_error("no such cap");
             const auto c = atlas.coefficients_of(atlas.caps[i]);
             return array_of(std::vector<double>(c.begin(), c.end()));
           })
      .def_prop_ro("blend", [](const Atlas& atlas) { return to_string(atlas.blend); })
      .def_ro("spacing", &Atlas::spacing)
      .def_ro("noise", &Atlas::noise)
      .def_ro("diagonal", &Atlas::diagonal)
      .def_ro("band", &Atlas::band);
  m.def("highest_degree", &highest_degree);
  m.def("n_coefficients", [](const std::string& basis, int degree) {
    return n_coefficients(parse_name<CapBasis>(basis), degree);
  });
  m.def("evaluate_cap", [](const Atlas& atlas, std::size_t i, const Rows& points) {
    if (i >= atlas.caps.size()) throw nb::index_error("no such cap");
    const Cap& cap = atlas.caps[i];
    std::vector<double> distances, valid;
    std::vector<Vec3> gradients;
    for (const Vec3& x : span_of(points)) {
      const CapValue value = evaluate(cap, atlas.coefficients_of(cap), x);
      distances.push_back(value.distance);
      gradients.push_back(value.gradient);
      valid.push_back(value.valid ? 1 : 0);
    }
    return nb::make_tuple(array_of(std::move(distances)), array_of(std::move(gradients)),
                          array_of(std::move(valid)));
  });
}

template <class T>
nb::bytes bytes_of(const std::vector<T>& values) {
  return nb::bytes(values.data(), values.size() * sizeof(T));
}
template <class T>
std::vector<T> values_of_bytes(nb::handle state) {
  const auto bytes = nb::cast<nb::bytes>(state);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.c_str(), values.size() * sizeof(T));
  return values;
}

nb::tuple state_of_rules(const SurfaceRules& rules) {
  nb::object simplify = nb::none(), seen = nb::none();
  if (rules.simplify) {
    const SimplifyOptions& s = *rules.simplify;
    simplify = nb::make_tuple(s.faces, s.share, s.max_error);
  }
  if (rules.seen) {
    const SeenCubes& s = *rules.seen;
    seen = nb::make_tuple(s.origin.x, s.origin.y, s.origin.z, s.edge, s.size[0], s.size[1],
                          s.size[2], bytes_of(s.bits));
  }
  return nb::make_tuple(to_string(rules.holes), rules.min_component, simplify,
                        bytes_of(rules.spacing_places), bytes_of(rules.spacings), seen, rules.tiles,
                        rules.left_out);
}

SurfaceRules rules_of_state(const nb::object& state) {
  const auto parts = nb::cast<nb::tuple>(state);
  SurfaceRules rules;
  rules.holes = parse_name<HolePolicy>(nb::cast<std::string>(parts[0]));
  rules.min_component = nb::cast<double>(parts[1]);
  if (!parts[2].is_none()) {
    const auto s = nb::cast<nb::tuple>(parts[2]);
    rules.simplify = SimplifyOptions{nb::cast<std::size_t>(s[0]), nb::cast<double>(s[1]),
                                     nb::cast<double>(s[2])};
  }
  rules.spacing_places = values_of_bytes<Vec3>(parts[3]);
  rules.spacings = values_of_bytes<double>(parts[4]);
  if (!parts[5].is_none()) {
    const auto s = nb::cast<nb::tuple>(parts[5]);
    const auto size = [&](std::size_t k) { return nb::cast<std::size_t>(s[4 + k]); };
    rules.seen = SeenCubes{{nb::cast<double>(s[0]), nb::cast<double>(s[1]), nb::cast<double>(s[2])},
                           nb::cast<double>(s[3]),
                           {size(0), size(1), size(2)},
                           values_of_bytes<std::uint8_t>(s[7])};
    if (8 * rules.seen->bits.size() < size(0) * size(1) * size(2)) {
      throw Error(ErrorCode::kInvalidInput, "the pickled seen space has too few cubes");
    }
  }
  if (rules.spacings.size() != rules.spacing_places.size()) {
    throw Error(ErrorCode::kInvalidInput, "pickled spacings have no places");
  }
  rules.tiles = nb::cast<bool>(parts[6]);
  rules.left_out = nb::cast<std::vector<std::string>>(parts[7]);
  return rules;
}

void bind_rules(nb::module_& m) {
  nb::class_<SurfaceRules> rules(m, "SurfaceRules",
                                 "Rules with which `reconstruct` made a surface from caps; an "
                                 "atlas with them makes the same surface again.");
  bind_state(rules, &state_of_rules, &rules_of_state);
  rules.def("__repr__", [](nb::handle self) { return record_text(self); })
      .def(
          "__eq__",
          [](const SurfaceRules& self, nb::handle other) -> nb::object {
            SurfaceRules* same = nullptr;
            if (other.is_none() || !nb::try_cast(other, same)) {
              return nb::borrow(Py_NotImplemented);
            }
            return nb::bool_(state_of_rules(self).equal(state_of_rules(*same)));
          },
          nb::arg().none(), nb::sig("def __eq__(self, arg: object, /) -> bool"))
      .def("__hash__",
           [](const SurfaceRules&) -> std::size_t { throw nb::type_error("a record has no hash"); })
      .def(
          "to_dict", [](nb::handle self) { return record_dict(self); },
          "Returns all fields by name; records in fields become dicts, too.")
      .def_prop_ro(
          "holes", [](const SurfaceRules& r) { return to_string(r.holes); },
          "Places without points; 'fill': they are closed; 'keep': they are cut open.")
      .def_ro("min_component", &SurfaceRules::min_component,
              "Share of the largest part's area below which a part is dropped.")
      .def_prop_ro(
          "simplified", [](const SurfaceRules& r) { return r.simplify.has_value(); },
          "True if the surface was simplified.")
      .def_ro("tiles", &SurfaceRules::tiles,
              "True if the surface was made in several tiles. `Atlas.mesh` then has another order "
              "of vertices and faces, and closed holes may differ by some steps of the grid.")
      .def_ro(
          "left_out", &SurfaceRules::left_out,
          "Names of attributes that the surface has from the points, and the atlas does not hold.");
}

void bind_models(nb::module_& m) {
  bind_rules(m);
  Record<AtlasErrors>(m, "AtlasErrors", "Measured errors of an atlas, in the unit of the shape.")
      .fields()
      .property(
          "rms", [](const AtlasErrors& e) { return e.rms(); },
          "Root mean square distance, the larger of both directions.")
      .property(
          "max", [](const AtlasErrors& e) { return e.max(); },
          "Largest distance, the larger of both directions.")
      .property(
          "two_sided", [](const AtlasErrors& e) { return e.two_sided(); },
          "True if both directions were measured.");
  Record<AtlasSize>(m, "AtlasSize", "Size of an atlas.")
      .fields()
      .property(
          "numbers", [](const AtlasSize& s) { return s.numbers(); },
          "Number of values of the whole model: coefficients and frame numbers.");
  nb::class_<AtlasModel> model_type(m, "AtlasModel", "An atlas and the metadata of its file.");
  bind_state(
      model_type,
      [](const AtlasModel& self) {
        return nb::make_tuple(self.atlas, self.step, self.tolerance, self.errors,
                              self.input_numbers, self.unit, self.method, self.rules);
      },
      [](const nb::object& state) {
        const auto parts = nb::cast<nb::tuple>(state);
        AtlasModel made;
        made.atlas = nb::cast<Atlas>(parts[0]);
        made.step = nb::cast<double>(parts[1]);
        made.tolerance = nb::cast<double>(parts[2]);
        made.errors = nb::cast<std::optional<AtlasErrors>>(parts[3]);
        made.input_numbers = nb::cast<std::size_t>(parts[4]);
        made.unit = nb::cast<std::string>(parts[5]);
        made.method = nb::cast<std::string>(parts[6]);
        made.rules = nb::cast<std::optional<SurfaceRules>>(parts[7]);
        return made;
      });
  model_type.def_prop_ro("atlas", [](const AtlasModel& self) { return self.atlas; })
      .def_ro("step", &AtlasModel::step)
      .def_ro("tolerance", &AtlasModel::tolerance)
      .def_ro("errors", &AtlasModel::errors)
      .def_ro("input_numbers", &AtlasModel::input_numbers)
      .def_ro("unit", &AtlasModel::unit)
      .def_ro("method", &AtlasModel::method)
      .def_ro("rules", &AtlasModel::rules)
      .def("with_unit", [](AtlasModel named, const std::string& unit) {
        named.unit = unit;
        return named;
      });
  m.def("size_of", &size_of);
  m.def("write_atlas", [](const AtlasModel& model, const std::string& path, const Caller& caller) {
    caller.run([&](const Context&) { write_atlas(model, path); });
  });
  m.def("read_atlas", [](const std::string& path, const Caller& caller) {
    return caller.run([&](const Context&) { return read_atlas(path); });
  });
  m.def("is_atlas_file", [](const std::string& path) { return is_atlas_file(path); });
}

void bind_compress(nb::module_& m) {
  Options<CompressOptions>(m, "CompressOptions",
                           "Options of `compress`: limits of the size and the error of an atlas.")
      .fields();
  Record<CompressReport>(m, "CompressReport", "Report of `compress`.").fields();
  m.def("compress", [](const Shape& shape, const CompressOptions& options, const Caller& caller) {
    Compressed result = caller.run([&](const Context& context) {
      return std::visit([&](const auto* s) { return compress(*s, options, context); }, shape);
    });
    return nb::make_tuple(std::move(result.model), std::move(result.report));
  });
  Options<AtlasSynthesisOptions>(m, "AtlasSynthesisOptions",
                                 "Options for extracting the surface of an atlas.")
      .fields();
  m.def("synthesize_atlas", [](const AtlasModel& model, const AtlasSynthesisOptions& options,
                               const Caller& caller) {
    return caller.run([&](const Context& context) { return synthesize(model, options, context); });
  });
  m.def("dominant_caps", [](const Atlas& atlas, const Rows& points, const Caller& caller) {
    const std::vector<Vec3> at = vector_of(points);
    return array_of(
        caller.run([&](const Context& context) { return dominant_caps(atlas, at, context); }));
  });
  const auto colors = [](auto set) {
    return [set](const Atlas& atlas, const std::vector<std::uint32_t>& caps) {
      for (const std::uint32_t cap : caps) {
        if (cap != kNoCap && cap >= atlas.caps.size()) {
          throw Error(ErrorCode::kInvalidInput, "the atlas has no cap " + std::to_string(cap));
        }
      }
      std::vector<Attribute> attributes;
      set(attributes, atlas, caps);
      nb::list channels;
      for (const Attribute& channel : attributes) channels.append(array_of(channel.values));
      return channels;
    };
  };
  m.def("set_cap_colors", colors(&set_cap_colors));
  m.def("set_degree_colors", colors(&set_degree_colors));
}

void bind_patch_atlas(nb::module_& m) {
  Options<PatchAtlasOptions>(m, "PatchAtlasOptions",
                             "Options of `patch_atlas`: the paper's parameters.")
      .fields();
  m.def("patch_atlas", [](const Shape& shape, const PatchAtlasOptions& options,
                          const Caller& caller) {
    PatchAtlas result = caller.run([&](const Context& context) {
      return std::visit([&](const auto* s) { return patch_atlas(*s, options, context); }, shape);
    });
    return nb::make_tuple(std::move(result.model), std::move(result.surface),
                          result.rms_along_rays);
  });
  m.def("patch_picture", [](const Shape& shape, const std::string& view,
                            const PatchAtlasOptions& options, const Caller& caller) {
    const PatchView wanted = parse_name<PatchView>(view);
    PatchPicture picture = caller.run([&](const Context& context) {
      return std::visit([&](const auto* s) { return patch_picture(*s, wanted, options, context); },
                        shape);
    });
    return nb::make_tuple(std::move(picture.mesh), picture.patches);
  });
}

}  // namespace

void bind_atlases(nb::module_& m) {
  bind_caps(m);
  bind_models(m);
  bind_compress(m);
  bind_patch_atlas(m);
}

}  // namespace rholm::python
