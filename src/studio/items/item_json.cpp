// Items as JSON for the page.
#include <algorithm>

#include "studio/items/item.h"
#include "studio/items/model.h"
#include "studio/items/saved_formats.h"

namespace rholm::studio {
namespace {

// Returns the degrees of a table for display: all small ones, then six per octave.
std::vector<int> shown_degrees(int last) {
  std::vector<int> degrees;
  for (int d = 0; d < last; d += std::max(1, d / 6)) degrees.push_back(d);
  degrees.push_back(last);
  return degrees;
}

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::optional<double> max_of(const Model& model, int degree) {
  if (model.max.empty()) return std::nullopt;
  return model.max[static_cast<std::size_t>(degree)];
}

}  // namespace

Json rms_json(const Model& model) {
  if (!model.beyond) return nullptr;
  Json list = Json::array();
  for (const std::optional<double>& rms : model.beyond->rms) list.push_back(number(rms));
  return list;
}

namespace {

Json expansion_json(const Model& model) {
  const Expansion& expansion = model.expansion;
  const int degree = expansion.coefficients.degree();
  Json json = {{"degree", degree},
               {"function", to_string(expansion.function)},
               {"center", {expansion.center.x, expansion.center.y, expansion.center.z}},
               {"rms_per_degree", rms_json(model)},
               {"error", Json::array()},
               {"tail", nullptr},
               {"power", model.power}};
  if (model.beyond || !model.max.empty() || rms_at(model, degree)) {
    for (const int d : shown_degrees(degree)) {
      json["error"].push_back({d, number(rms_at(model, d)), number(max_of(model, d))});
    }
  }
  if (expansion.tail_strength) json["tail"] = {{"strength", *expansion.tail_strength}};
  return json;
}

Json table_json(const TableColumns& told) {
  Json columns = Json::array();
  for (const TableColumn& column : told.columns) {
    columns.push_back({{"name", column.name}, {"taken_for", column.taken_for}});
  }
  return {{"columns", std::move(columns)}, {"note", told.note}, {"unsure", told.unsure}};
}

Json atlas_json(const Item& item) {
  Json json = {{"bytes", item.atlas_file->size()},
               {"degree", highest_degree(item.atlas->atlas)},
               {"error", nullptr}};
  if (const auto& errors = item.atlas->errors) {
    json["error"] = {{"rms", errors->rms()}, {"max", errors->max()}};
  }
  return json;
}

Json saved_json(const Item& item) {
  Json saved = Json::array();
  for (const SavedFormat& format : saved_formats(item)) {
    saved.push_back({{"format", format.file->name},
                     {"label", format.label},
                     {"extension", format.file->extensions.front().name}});
  }
  return saved;
}

}  // namespace

std::vector<SavedFormat> saved_formats(const Item& item) {
  std::vector<SavedFormat> shapes, coefficients;
  for (const ShapeFormatInfo& format : shape_formats()) {
    if (!format.file.written || !(item.points ? format.points : format.faces)) continue;
    shapes.push_back({.file = &format.file,
                      .label = (item.points ? "Points, " : "Mesh, ") + format.file.title,
                      .is_shape = true});
  }
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    if (!format.file.written || !(item.model || (item.atlas && !format.format))) continue;
    coefficients.push_back({.file = &format.file,
                            .label = (format.format ? "Coefficients, " : "") + format.file.title});
  }
  std::vector<SavedFormat>& first = item.atlas ? coefficients : shapes;
  const std::vector<SavedFormat>& second = item.atlas ? shapes : coefficients;
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Json json_of(const Item& item) {
  const std::vector<Vec3>& at = item.points ? item.points->points : item.shown->vertices;
  const Bounds box = bounds(at);
  const Vec3 middle = 0.5 * box.min + 0.5 * box.max;
  Json json = {{"id", item.id},
               {"name", item.name},
               {"kind", to_string(item.kind)},
               {"revision", item.revision},
               {"facts", facts_json(item)},
               {"vertices", at.size()},
               {"faces", item.shown ? item.shown->faces.size() : 0},
               {"diagonal", box.diagonal()},
               {"center", {middle.x, middle.y, middle.z}},
               {"unit", item.unit},
               {"closed", item.facts && item.facts->inspection.closed},
               {"star", star_json(item)},
               {"expansion", item.model ? expansion_json(*item.model) : Json(nullptr)},
               {"table", item.table ? table_json(item.table->told) : Json(nullptr)},
               {"warnings", item.warnings},
               {"normals", item.points && !item.points->normals.empty()},
               {"caps", item.caps},
               {"placed", item.placed.empty() ? Json(nullptr) : Json(item.placed)},
               {"atlas", item.atlas ? atlas_json(item) : Json(nullptr)},
               {"saved_as", saved_json(item)},
               {"look", nullptr}};
  if (item.model) {
    json["look"] = {{"degree", item.look.degree},
                    {"gains", item.look.gains.empty() ? Json(nullptr) : Json(item.look.gains)}};
  } else if (item.limit) {
    json["look"] = {{"degree", *item.limit}, {"gains", nullptr}};
  }
  return json;
}

}  // namespace rholm::studio
