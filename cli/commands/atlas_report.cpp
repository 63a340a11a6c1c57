// Reports of atlases, and rholm info for an atlas.
#include "cli/commands/atlas_report.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/plain_text.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/terminal/field_json.h"

namespace rholm::cli {
namespace {

double share_of(const AtlasModel& model) {
  return static_cast<double>(size_of(model.atlas).numbers()) /
         static_cast<double>(model.input_numbers);
}

std::string length_text(double value, double diagonal) {
  return diagonal > 0
             ? fmt::format("{} ({} of the diagonal)", text_of(value), text_of(value / diagonal))
             : text_of(value);
}

}  // namespace

std::string left_out_text(const SurfaceRules& rules) {
  std::string names;
  for (const std::string& name : rules.left_out) {
    names += (names.empty() ? "" : ", ") + escaped_line(name);
  }
  return (rules.left_out.size() == 1 ? "the attribute " : "the attributes ") + names;
}

namespace {

Json rules_json(const SurfaceRules& rules) {
  return {{"holes", to_string(rules.holes)},
          {"min_component", rules.min_component},
          {"simplified", rules.simplify.has_value()},
          {"spacings", rules.spacings.size()},
          {"seen_space", rules.seen.has_value()},
          {"tiles", rules.tiles},
          {"left_out", rules.left_out}};
}

std::string rules_text(const SurfaceRules& rules) {
  std::string made = rules.holes == HolePolicy::kFill ? "holes closed" : "holes open";
  if (rules.simplify) made += ", simplified";
  if (rules.tiles) made += ", in tiles: what closes holes may differ by some steps of the grid";
  std::string text = line("surface", made);
  if (!rules.left_out.empty()) text += line("not held", left_out_text(rules));
  return text;
}

}  // namespace

Json atlas_json(const AtlasModel& model) {
  const AtlasSize size = size_of(model.atlas);
  Json json = json_of_fields(size);
  json["numbers"] = size.numbers();
  json["highest_degree"] = highest_degree(model.atlas);
  json["input_numbers"] = model.input_numbers;
  json["numbers_per_input_number"] =
      model.input_numbers > 0 ? Json(share_of(model)) : Json(nullptr);
  json["diagonal"] = model.atlas.diagonal;
  json["tolerance"] = model.tolerance;
  json["step"] = model.step;
  json["unit"] = model.unit;
  json["method"] = model.method;
  json["errors"] = nullptr;
  if (model.errors) {
    const AtlasErrors& e = *model.errors;
    const auto measured = [&](double value) { return e.two_sided() ? Json(value) : Json(nullptr); };
    json["errors"] = {{"rms_from_shape", e.rms_from},
                      {"max_from_shape", e.max_from},
                      {"rms_to_shape", measured(e.rms_to)},
                      {"max_to_shape", measured(e.max_to)}};
  }
  json["reconstruction"] = model.rules ? rules_json(*model.rules) : Json(nullptr);
  return json;
}

std::string atlas_text(const AtlasModel& model) {
  const AtlasSize size = size_of(model.atlas);
  const double diagonal = model.atlas.diagonal;
  std::string text =
      line("caps", fmt::format("{}, degrees up to {}", size.caps, highest_degree(model.atlas)));
  text += line("numbers", fmt::format("{}: {} coefficients, {} of frames", size.numbers(),
                                      size.coefficients, size.frame_numbers));
  if (model.input_numbers > 0) {
    text += line("of the input", fmt::format("{:.2f} % of its {} coordinates",
                                             100 * share_of(model), model.input_numbers));
  }
  if (model.tolerance > 0)
    text += line("tolerance", length_text(model.tolerance, diagonal) + " rms");
  if (model.errors) {
    const AtlasErrors& e = *model.errors;
    text += line("distance", length_text(e.rms_from, diagonal) + " rms from the shape, measured");
    text += line("", e.two_sided() ? length_text(e.rms_to, diagonal) + " rms to the shape, measured"
                                   : "not measured to the shape, which is points");
    text += line("", length_text(e.max(), diagonal) + " at most, measured");
  }
  text += line("diagonal", text_of(diagonal));
  text += line("resolution", text_of(model.step));
  if (model.rules) text += rules_text(*model.rules);
  if (!model.unit.empty()) text += line("unit", model.unit);
  return text;
}

int report_atlas(const std::string& path, bool as_json) {
  const AtlasModel model = read_atlas(path);
  const auto bytes = file_size_of(path);
  Json json;
  json["file"] = path;
  json["kind"] = "atlas";
  json["format"] = "model";
  json["bytes"] = bytes ? Json(*bytes) : Json(nullptr);
  json.update(atlas_json(model));
  std::string text = fmt::format("{}: atlas of caps, model\n", display_name(path));
  if (bytes) text += line("bytes", fmt::format("{}", *bytes));
  text += atlas_text(model);
  as_json ? print_json(json) : print_text(text);
  return 0;
}

}  // namespace rholm::cli
