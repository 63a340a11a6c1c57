// Makes the report of an atlas of caps.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/parallel.h"
#include "model/atlas/atlas_level.h"
#include "report/page/html.h"
#include "report/page/report_atlas.h"
#include "report/page/report_data.h"
#include "report/page/report_markup.h"
#include "report/page/report_pictures.h"
#include "report/page/report_plot.h"
#include "rholm/compare.h"
#include "rholm/error.h"
#include "rholm/report.h"

namespace rholm {
namespace {

using namespace report;

// Surface with the degrees up to a limit, compared with the shape.
struct DrawnLevel {
  int degree = 0;
  std::size_t coefficients = 0;
  Mesh mesh;
  std::optional<Comparison> comparison;  // a: the shape, b: this surface
};

struct AtlasData {
  const AtlasModel& model;
  const Mesh* shape;
  const ReportOptions& options;
  AtlasSize size;
  std::vector<DrawnLevel> levels;  // ascending degrees, the last one with all degrees
};

std::string length_of(double value, const AtlasData& data, int digits) {
  return html::length(value, data.model.unit, digits);
}

// Returns the errors that the model stores; without them, the errors measured here.
std::optional<AtlasErrors> errors_of(const AtlasData& data) {
  if (data.model.errors) return data.model.errors;
  const std::optional<Comparison>& c = data.levels.back().comparison;
  if (!c) return std::nullopt;
  return AtlasErrors{c->a_to_b.rms, c->a_to_b.max, c->b_to_a.rms, c->b_to_a.max};
}

std::string lead(const AtlasData& data) {
  std::string text = fmt::format(
      "A surface as {} overlapping caps, each a series of spherical harmonics about a sphere of "
      "its own",
      html::count(data.size.caps));
  if (data.shape != nullptr && !data.options.shape_name.empty()) {
    text += ", beside the shape " + html::escaped(data.options.shape_name);
  }
  return text + ".";
}

std::string facts(const AtlasData& data) {
  std::string html = "<dl class=\"facts\">\n" + fact("caps", html::count(data.size.caps), "");
  html += fact("degrees", fmt::format("up to {}", data.levels.back().degree), "");
  std::string small;
  if (data.model.input_numbers > 0) {
    const double share = 100 * static_cast<double>(data.size.numbers()) /
                         static_cast<double>(data.model.input_numbers);
    small = fmt::format("{}&nbsp;% of the input&#8217;s", html::number(share, 3));
  }
  html += fact("numbers", html::count(data.size.numbers()), small);
  if (const auto errors = errors_of(data)) {
    html += fact("rms distance", length_of(errors->rms(), data, 3),
                 part_of(errors->rms(), data.model.atlas.diagonal));
    html += fact("largest distance", length_of(errors->max(), data, 3),
                 part_of(errors->max(), data.model.atlas.diagonal));
  }
  if (data.options.file_bytes) {
    small = data.shape ? "the mesh: " + size_text(bytes_of(*data.shape)) : "";
    html += fact("file", size_text(static_cast<double>(*data.options.file_bytes)), small);
  }
  return html + "</dl>\n";
}

std::string levels_section(const AtlasData& data, const Context& context) {
  std::vector<Panel> panels;
  panels.reserve(data.levels.size() + 1);
  for (const DrawnLevel& level : data.levels) panels.push_back(panel_of(level.mesh, true));
  if (data.shape != nullptr) panels.push_back(panel_of(*data.shape, false));
  const std::vector<Picture> pictures = draw_row(panels, data.options.picture_size, context);
  std::string html = fmt::format("<div class=\"pictures n{}\">\n", pictures.size());
  for (std::size_t k = 0; k < data.levels.size(); ++k) {
    const DrawnLevel& level = data.levels[k];
    const std::string rms =
        level.comparison
            ? "<br><small>rms " + part_of(level.comparison->a_to_b.rms, data.model.atlas.diagonal) +
                  "</small>"
            : "";
    html += figure_of(pictures[k], fmt::format("Picture of the model at degree {}", level.degree),
                      fmt::format("degrees up to {}", level.degree) + rms);
  }
  if (data.shape != nullptr) {
    html += figure_of(pictures.back(), "Picture of the shape " + data.options.shape_name,
                      "the shape<br><small>" + html::escaped(data.options.shape_name) + "</small>");
  }
  return section("Shape and model", html + "</div>\n");
}

std::string caps_section(const AtlasData& data, const Context& context) {
  Mesh colored = data.levels.back().mesh;
  const Atlas& atlas = data.model.atlas;
  set_cap_colors(colored.attributes, atlas, dominant_caps(atlas, colored.vertices, context));
  Panel panel = panel_of(colored, true);
  panel.colors = vertex_colors(colored);
  const std::vector<Picture> sides =
      draw_sides(panel, data.options.picture_size, std::nullopt, context);
  std::string html = "<div class=\"pictures n2\">\n";
  html += figure_of(sides[0], "Picture of the caps in colours", "from one side");
  html += figure_of(sides[1], "Picture of the caps in colours, seen from the opposite side",
                    "from the opposite side");
  return section("Caps", html + "</div>\n" +
                             note("Each point has the colour of the cap that has most to say "
                                  "there; caps overlap and are blended."));
}

std::string map_section(const AtlasData& data, const Context& context) {
  if (data.shape == nullptr) return "";
  const Mesh& surface = data.levels.back().mesh;
  const ErrorMap map = draw_errors(surface, *data.shape, data.options.picture_size, context);
  std::string caption = fmt::format(
      "Distance from the model to the closest point of {}{}.", name_of_shape(data.options),
      data.model.unit.empty() ? "" : ", in " + html::escaped(data.model.unit));
  if (map.largest > map.scale.max)
    caption += " One point in 500 is farther and has the last colour.";
  const std::string part = part_of(map.largest, data.model.atlas.diagonal);
  caption += fmt::format(" The largest at the {} vertices of this picture is {}{}.",
                         html::count(surface.vertices.size()), length_of(map.largest, data, 3),
                         part.empty() ? "" : " (" + part + ")");
  return section("Where the model differs", error_map(map, "the model", caption, data.model.unit));
}

std::string spectrum_section(const AtlasData& data) {
  const std::vector<double> heights = cap_heights_by_degree(data.model.atlas);
  Series series{.label = "rms height that a degree adds to a cap", .points = {}, .marks = true};
  for (std::size_t l = 1; l < heights.size(); ++l) {
    series.points.push_back({static_cast<double>(l), heights[l]});
  }
  const std::string figure = plot_figure(
      {.id = "heights",
       .title = "Height per degree",
       .description = "On logarithmic axes: the rms height over its sphere that each degree adds "
                      "to a cap, over the degree",
       .y_label = with_unit("height", data.model.unit),
       .x_max = static_cast<double>(heights.size() - 1),
       .series = {series}});
  if (figure.empty()) return "";
  return section("Spectrum",
                 "<div class=\"plots\">\n" + figure + "</div>\n" +
                     note("Root mean square over all caps, by their size, of a degree's part of "
                          "the radius over the whole sphere of the cap. Degrees are those of the "
                          "opened sphere: a cap fills half of it or less."));
}

std::string degrees_section(const AtlasData& data) {
  const std::string& unit = data.model.unit;
  Table table{.label = "Errors by degree",
              .columns = {{"degrees up to", true}, {"coefficients", true}, {"faces", true}},
              .rows = {}};
  if (data.shape != nullptr) {
    table.columns.push_back({with_unit("rms from<br>the shape", unit), true});
    table.columns.push_back({with_unit("rms to<br>the shape", unit), true});
    table.columns.push_back({with_unit("largest<br>distance", unit), true});
  }
  const auto cell = [&](double length) {
    return two_lines(html::length(length, ""), part_of(length, data.model.atlas.diagonal));
  };
  for (const DrawnLevel& level : data.levels) {
    Row row{{std::to_string(level.degree), html::count(level.coefficients),
             html::count(level.mesh.faces.size())},
            &level == &data.levels.back()};
    if (level.comparison) {
      row.cells.push_back(cell(level.comparison->a_to_b.rms));
      row.cells.push_back(cell(level.comparison->b_to_a.rms));
      row.cells.push_back(cell(level.comparison->hausdorff));
    }
    table.rows.push_back(std::move(row));
  }
  std::string text = fmt::format(
      "Coefficients that are zero are not counted. The frames of the caps are {} numbers more.",
      html::count(data.size.frame_numbers));
  if (data.shape != nullptr) {
    text += fmt::format(
        " Distances are those of {} points on each surface to the closest points "
        "of the other; smaller figures are parts of the diagonal <i>d</i>.",
        html::count(data.levels.back().comparison->samples));
  }
  return section("Degree by degree", markup_of(table) + note(text));
}

std::string figures_section(const AtlasData& data) {
  const std::string& unit = data.model.unit;
  Table table{
      .label = "Figures of the model", .columns = {{"figure", false}, {"value", true}}, .rows = {}};
  const auto row = [&](const std::string& name, const std::string& value) {
    table.rows.push_back({{name, value}});
  };
  const Atlas& atlas = data.model.atlas;
  row(with_unit("diagonal <i>d</i> of the bounding box", unit), html::number(atlas.diagonal, 6));
  if (data.model.tolerance > 0) {
    row(with_unit("tolerance that was asked for, rms", unit), html::number(data.model.tolerance));
  }
  row(with_unit("edge of the grid's cubes", unit), html::number(data.model.step));
  if (atlas.noise > 0) {
    row(with_unit("noise of the points, standard deviation", unit), html::number(atlas.noise));
  }
  std::vector<double> radii;
  radii.reserve(atlas.caps.size());
  for (const Cap& cap : atlas.caps) radii.push_back(cap.frame.support);
  std::sort(radii.begin(), radii.end());
  row(with_unit("radius of a cap: smallest", unit), html::number(radii.front()));
  row(with_unit("radius of a cap: median", unit), html::number(radii[radii.size() / 2]));
  row(with_unit("radius of a cap: largest", unit), html::number(radii.back()));
  return section("In figures", markup_of(table));
}

std::string conventions_section(const AtlasData& data) {
  std::string html =
      "<p>A cap looks at the surface from a centre on its inner side. In its own frame the surface "
      "is at distance</p>\n"
      "<p class=\"formula\"><i>r</i>(&#952;, &#966;) = <i>R</i><sub>0</sub> (1 + "
      "&#931;<sub><i>lm</i></sub> [<i>C<sub>lm</sub></i>&#8239;cos&#8239;<i>m</i>&#966; + "
      "<i>S<sub>lm</sub></i>&#8239;sin&#8239;<i>m</i>&#966;] "
      "<i>N<sub>m</sub></i>&#8239;<i>P<sub>lm</sub></i>(cos&#8239;&#952;&#8242;)),</p>\n"
      "<p>where tan(&#952;&#8242;/2) = <i>a</i>&#8239;tan(&#952;/2) opens the cap to a hemisphere. "
      "The functions are real and orthonormal, without Condon&#8211;Shortley phase. Where caps "
      "overlap, their signed distances are blended.</p>\n";
  std::string text = "Lengths are in ";
  text += data.model.unit.empty() ? "the unit of the shape, which is not said"
                                  : html::escaped(data.model.unit);
  if (!data.model.method.empty()) {
    text += fmt::format(". The caps were found by the method &#8220;{}&#8221;",
                        html::escaped(data.model.method));
  }
  return section("Conventions", html + paragraph(text + "."));
}

std::vector<DrawnLevel> make_levels(const AtlasModel& model, const Mesh* shape,
                                    const Context& context) {
  constexpr std::size_t kSamples = 100000;
  const AtlasSurfaceOptions grid{.step = model.step};
  Mesh whole = synthesize(model, {}, context);
  const LevelMaker maker(model.atlas, whole, context);
  std::vector<DrawnLevel> levels;
  const auto add = [&](int degree, Mesh mesh) {
    if (mesh.faces.empty()) return;  // with a low degree no surface may be left
    DrawnLevel level{degree, coefficients_up_to(model.atlas, degree), std::move(mesh), {}};
    if (shape != nullptr) {
      level.comparison = compare(*shape, level.mesh, {.samples = kSamples}, context);
    }
    levels.push_back(std::move(level));
  };
  const int highest = highest_degree(model.atlas);
  for (const int limit : drawn_limits(model.atlas)) {
    report_progress(context, "surfaces", 0);
    if (limit == highest || (!levels.empty() && limit <= levels.back().degree)) continue;
    const AtlasLevel level = maker.usable_from(limit);
    if (level.degree < highest) {
      add(level.degree, level_surface(level.atlas, whole, grid, context));
    }
  }
  add(highest, std::move(whole));
  return levels;
}

}  // namespace

std::string report_html(const AtlasModel& model, const Mesh* shape, const ReportOptions& options,
                        const Context& context) {
  check(shape, options);
  if (model.atlas.caps.empty()) {
    throw Error(ErrorCode::kInvalidInput, "the atlas has no cap: there is nothing to draw");
  }
  const AtlasData data{model, shape, options, size_of(model.atlas),
                       make_levels(model, shape, context)};
  std::string sections = levels_section(data, context) + caps_section(data, context);
  sections += map_section(data, context) + spectrum_section(data) + degrees_section(data);
  sections += figures_section(data) + conventions_section(data) + commands_section(options);
  return page(options, lead(data), facts(data), sections);
}

}  // namespace rholm
