#include "studio/answers.h"

#include <algorithm>
#include <charconv>

#include "rholm/error.h"
#include "rholm/filter.h"
#include "studio/items/arrays.h"
#include "studio/items/binary.h"

namespace rholm::studio {
namespace {

constexpr std::size_t kMaxShownPoints = 2000000;  // chosen: the pixels of a current screen

// Returns every n-th point, evenly, so that at most kMaxShownPoints are left.
PointCloud thinned(const PointCloud& cloud) {
  const std::size_t step = (cloud.points.size() + kMaxShownPoints - 1) / kMaxShownPoints;
  if (step <= 1) return cloud;
  PointCloud thin;
  for (const Attribute& a : cloud.attributes) thin.attributes.push_back({a.name, a.type, {}});
  for (std::size_t i = 0; i < cloud.points.size(); i += step) {
    thin.points.push_back(cloud.points[i]);
    if (!cloud.normals.empty()) thin.normals.push_back(cloud.normals[i]);
    for (std::size_t k = 0; k < thin.attributes.size(); ++k) {
      thin.attributes[k].values.push_back(cloud.attributes[k].values[i]);
    }
  }
  return thin;
}

Response points_answer(const Item& item) {
  const PointCloud cloud = thinned(*item.points);
  const std::size_t n = cloud.points.size();
  Binary binary;
  binary.add("positions", floats_of(cloud.points), {n, 3});
  if (!cloud.normals.empty()) {
    std::vector<Vec3> units;
    units.reserve(n);
    for (const Vec3& v : cloud.normals) units.push_back(norm(v) > 0 ? v / norm(v) : Vec3{});
    binary.add("normals", floats_of(units), {n, 3});
  }
  const std::vector<std::uint8_t> colors = colors_of(cloud);
  if (!colors.empty()) binary.add("colors", colors, {n, 3});
  binary.meta = {
      {"item", item.id}, {"revision", item.revision}, {"of", item.points->points.size()}};
  return binary.response();
}

Json parameter_json(const WindowParameter& parameter) {
  const std::optional<double> standard = parameter.value({});
  return {{"name", parameter.name},
          {"symbol", parameter.symbol},
          {"help", parameter.help},
          {"whole", parameter.whole()},
          {"min", parameter.min},
          {"max", parameter.max},
          {"default", standard ? Json(*standard) : Json(nullptr)},
          {"replaces_cutoff", parameter.replaces_cutoff}};
}

template <typename Number>
Number number_in(const std::string& name, const std::string& text) {
  Number number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) {
    throw bad_request(name + " is '" + text + "', which is no number");
  }
  return number;
}

}  // namespace

Response json_response(const Json& json, int status) {
  return {.status = status, .body = text_of(json)};
}

Response surface_answer(const Item& item, bool original) {
  if (item.points) return points_answer(item);
  const Mesh& mesh = original && item.original ? *item.original : *item.shown;
  const std::size_t n = mesh.vertices.size(), m = mesh.faces.size();
  const std::vector<float> positions = floats_of(mesh.vertices);
  Binary binary;
  binary.add("positions", positions, {n, 3});
  binary.add("normals", normals_of(positions, mesh.faces, joined_triangles(mesh)), {n, 3});
  binary.add("triangles", indices_of(mesh.faces), {m, 3});
  // A series has the colours and the vertices of its shape.
  const std::vector<std::uint8_t> colors = colors_of(item.original ? *item.original : mesh);
  if (!colors.empty()) binary.add("colors", colors, {n, 3});
  if (item.atlas) {
    binary.add("labels", dominant_caps(item.atlas->atlas, mesh.vertices), {n});
  }
  if (item.facts && !item.facts->offending.empty()) {
    binary.add("offending", item.facts->offending, {item.facts->offending.size()});
  }
  binary.meta = {{"item", item.id}, {"revision", item.revision}};
  return binary.response();
}

Response measures_answer(const Item& item) {
  if (!item.model) throw Refusal(422, "wrong_kind", item.name + " has no expansion");
  const Model& model = *item.model;
  const auto list = [](const std::vector<double>& values) {
    return values.empty() ? Json(nullptr) : Json(values);
  };
  return json_response({{"degree", model.expansion.coefficients.degree()},
                        {"unit", item.unit},
                        {"power", model.power},
                        {"rms", rms_json(model)},
                        {"max", list(model.max)}});
}

Response windows_answer() {
  Json list = Json::array();
  for (const WindowInfo& info : windows()) {
    Json parameters = Json::array();
    for (const WindowParameter& one : info.parameters) parameters.push_back(parameter_json(one));
    list.push_back({{"name", info.name},
                    {"formula", info.formula},
                    {"help", info.help},
                    {"overshoot", info.overshoot},
                    {"parameters", parameters}});
  }
  return json_response({{"windows", list}, {"default", to_string(WindowOptions{}.window)}});
}

Response gains_answer(const std::map<std::string, std::string>& query) {
  const auto needed = [&](const char* name) {
    const auto found = query.find(name);
    if (found == query.end()) throw bad_request(std::string("gains need a ") + name);
    return found->second;
  };
  WindowOptions options = {.window = parse_window(needed("window"))};
  for (const WindowParameter& one : window_info(options.window).parameters) {
    const auto found = query.find(one.name);
    if (found != query.end()) one.set(options, number_in<double>(one.name, found->second));
  }
  const int cutoff = number_in<int>("cutoff", needed("cutoff"));
  const int degree = number_in<int>("degree", needed("degree"));
  return json_response({{"gains", low_pass(cutoff, degree, options)}});
}

}  // namespace rholm::studio
