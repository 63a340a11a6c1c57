#include "rholm/report.h"

#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/parallel.h"
#include "report/page/report_data.h"
#include "report/page/report_figures.h"
#include "report/page/report_markup.h"
#include "report/page/report_pictures.h"
#include "report/page/report_text.h"
#include "report/page/viewer_data.h"

namespace rholm {
namespace {

// Returns the coefficients without what they store about their own shape.
Expansion stranger(const Expansion& expansion) {
  Expansion result = expansion;
  result.norm_squared.reset();
  result.tail_strength.reset();
  result.errors.reset();
  return result;
}

std::string page_of(const Expansion& expansion, std::optional<report::ShapeFigures> shape,
                    const ReportOptions& options, const Context& context) {
  const report::Data data = report::find_data(expansion, std::move(shape), context);
  const report::Pictures pictures = report::draw(expansion, data, options, context);
  std::string sections, scripts;
  if (!options.viewer.empty()) {
    const Mesh* mesh = data.shape ? &data.shape->mesh : nullptr;
    sections += report::viewer_place();
    scripts = report::viewer_scripts(
        report::view_bytes(expansion, mesh, options.title, data, context), options.viewer);
  }
  sections += report::levels_section(expansion, data, options, pictures);
  sections += report::error_map_section(expansion, data, options, pictures);
  sections += report::spectrum_section(expansion, data, options);
  sections += report::degrees_section(expansion, data);
  sections += report::errors_section(expansion, data);
  sections += report::figures_section(expansion, data);
  sections += report::conventions_section(expansion, options);
  sections += report::commands_section(options);
  return report::page(options, report::lead(expansion, options), report::facts(expansion, data),
                      sections, scripts);
}

}  // namespace

std::string report_html(const Expansion& expansion, const Mesh* shape, const ReportOptions& options,
                        const Context& context) {
  require_surface(expansion);
  report::check(shape, options);
  std::optional<report::ShapeFigures> figures;
  if (shape != nullptr) {
    report_progress(context, "figures", 0);
    figures = report::shape_figures(*shape, expansion.center, options.weld_tolerance, context);
  }
  if (figures && !report::may_be_of(expansion, *figures)) {
    ReportOptions told = options;
    told.notes.push_back(
        fmt::format("{} is not the shape that these coefficients were found from, at least not as "
                    "it is joined here: what they keep of their own shape is left out.",
                    options.shape_name));
    return page_of(stranger(expansion), std::move(figures), told, context);
  }
  return page_of(expansion, std::move(figures), options, context);
}

}  // namespace rholm
