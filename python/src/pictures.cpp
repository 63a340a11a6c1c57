// Pictures and reports.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/error.h"
#include "rholm/file.h"
#include "rholm/render.h"
#include "rholm/report.h"

namespace rholm::python {
namespace {

using Pixels = nb::ndarray<const std::uint8_t, nb::shape<-1, -1, 3>, nb::c_contig, nb::device::cpu>;

Image image_of(const Pixels& pixels) {
  return {static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)),
          std::vector<std::uint8_t>(pixels.data(), pixels.data() + pixels.size())};
}

void color(Panel& panel, const std::optional<Doubles>& scalars, const std::optional<Rows>& colors) {
  if (scalars) panel.scalars = vector_of(*scalars);
  if (!colors) return;
  for (const Vec3& c : span_of(*colors)) {
    panel.colors.push_back(
        {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)});
  }
}

void bind_render(nb::module_& m) {
  nb::class_<Panel>(m, "Panel", "One thing in a picture; the mesh, or the points, must be kept.")
      .def(
          "__init__",
          [](Panel* self, const Mesh& mesh, const std::string& label, bool smooth,
             const std::optional<Doubles>& scalars, const std::optional<Rows>& colors) {
            Panel panel{.mesh = &mesh, .label = label, .smooth = smooth};
            color(panel, scalars, colors);
            new (self) Panel(std::move(panel));
          },
          nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(),
          nb::keep_alive<1, 2>())
      .def(
          "__init__",
          [](Panel* self, const PointCloud& points, const std::string& label, double radius,
             const std::optional<Doubles>& scalars, const std::optional<Rows>& colors) {
            Panel panel{.label = label, .points = &points, .point_radius = radius};
            color(panel, scalars, colors);
            new (self) Panel(std::move(panel));
          },
          nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(),
          nb::keep_alive<1, 2>());
  Options<RenderOptions>(m, "RenderOptions", "Size, point of view, light and colours.").fields();
  m.def("render", [](const std::vector<const Panel*>& panels, const RenderOptions& options,
                     const Caller& caller) {
    std::vector<Panel> all;
    all.reserve(panels.size());
    for (const Panel* panel : panels) all.push_back(*panel);
    Image image = caller.run([&](const Context& context) { return render(all, options, context); });
    const auto height = static_cast<std::size_t>(image.height);
    const auto width = static_cast<std::size_t>(image.width);
    return array_of<std::uint8_t>(std::move(image.rgb), {height, width, 3});
  });
  const auto rows_of = [](std::vector<std::array<float, 3>> colors) {
    const std::size_t n = colors.size();
    return array_of<float>(std::move(colors), {n, 3});
  };
  m.def("vertex_colors", [rows_of](const Mesh& mesh) { return rows_of(vertex_colors(mesh)); });
  m.def("vertex_colors",
        [rows_of](const PointCloud& cloud) { return rows_of(vertex_colors(cloud)); });
  m.def("spectrum_svg", &spectrum_svg, nb::arg(), nb::arg(), nb::arg().none());
  m.def("encode_png", [](const Pixels& pixels) {
    const Image image = image_of(pixels);
    const std::vector<char> png = unlocked([&] { return encode_png(image); });
    return nb::bytes(png.data(), png.size());
  });
  m.def("write_png",
        [](const std::string& path, const Pixels& pixels) { write_png(path, image_of(pixels)); });
  m.def("write_file", [](const std::string& path, const nb::bytes& bytes) {
    write_file(path, {bytes.c_str(), bytes.size()});
  });
}

void bind_pages(nb::module_& m) {
  Options<ReportOptions>(m, "ReportOptions", "What a page says beside its figures.")
      .fields()
      .type()
      .def("set_commands", [](ReportOptions& options,
                              const std::vector<std::pair<std::string, std::string>>& commands) {
        options.commands.clear();
        for (const auto& [what, command] : commands) {
          options.commands.push_back({what, command});
        }
      });
  m.def(
      "report_html",
      [](const std::variant<const Expansion*, const AtlasModel*>& model, const Mesh* shape,
         const ReportOptions& options, const Caller& caller) {
        return caller.run([&](const Context& context) {
          return std::visit(
              [&](const auto* it) { return report_html(*it, shape, options, context); }, model);
        });
      },
      nb::arg(), nb::arg().none(), nb::arg(), nb::arg());
  m.def(
      "view_data",
      [](const Expansion& expansion, const Mesh* shape, const std::string& title,
         const Caller& caller) {
        const std::string bytes = caller.run(
            [&](const Context& context) { return view_data(expansion, shape, title, context); });
        return nb::bytes(bytes.data(), bytes.size());
      },
      nb::arg(), nb::arg().none(), nb::arg(), nb::arg());
}

}  // namespace

void bind_pictures(nb::module_& m) {
  bind_render(m);
  bind_pages(m);
}

}  // namespace rholm::python
