#include "report/page/viewer_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include <fmt/format.h>

#include "report/page/html.h"
#include "report/page/report_markup.h"
#include "report/view/named_arrays.h"
#include "rholm/report.h"
#include "rholm/simplify.h"

namespace rholm::report {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json errors_of(const Data& data) {
  Json rows = Json::array();
  for (const DegreeRow& row : data.rows) {
    if (row.degree > kHighestDrawn) break;
    rows.push_back(
        Json::array({row.degree, number(row.rms), number(row.max ? row.max : row.max_distance)}));
  }
  return rows;
}

std::string meta_of(const Expansion& expansion, const std::string& title, const Data& data) {
  const Vec3& c = expansion.center;
  Json meta = {{"title", title},
               {"unit", expansion.unit},
               {"expansion",
                {{"degree", std::min(expansion.coefficients.degree(), kHighestDrawn)},
                 {"function", to_string(expansion.function)},
                 {"center", {c.x, c.y, c.z}}}},
               {"error", errors_of(data)},
               {"tail", nullptr}};
  if (expansion.tail_strength) meta["tail"] = {{"strength", *expansion.tail_strength}};
  return meta.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void add_mesh(const Mesh& mesh, NamedArrays& arrays) {
  arrays.add("positions", floats_of(mesh.vertices), {mesh.vertices.size(), 3});
  arrays.add("triangles", indices_of(mesh.faces), {mesh.faces.size(), 3});
}

void add_shape(const Mesh& shape, const Context& context, NamedArrays& arrays) {
  if (shape.faces.size() <= kMostFacesViewed) return add_mesh(shape, arrays);
  const Mesh simple = simplify(shape, {.faces = kMostFacesViewed}, context).mesh;
  // A mesh that cannot be simplified enough is left out.
  if (simple.faces.size() <= 2 * kMostFacesViewed) add_mesh(simple, arrays);
}

// Compares without regard to case; `small` is in lower case.
bool is_same_word(std::string_view text, std::string_view small) {
  return std::ranges::equal(text, small, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

// Escapes text so that strings, templates and regular expressions of JavaScript keep their meaning.
std::string inside_script(std::string_view script) {
  std::string text;
  text.reserve(script.size());
  for (std::size_t i = 0; i < script.size(); ++i) {
    text += script[i];
    if (script[i] != '<') continue;
    const std::string_view rest = script.substr(i + 1);
    const bool ends = is_same_word(rest.substr(0, 7), "/script");
    if (!ends && !rest.starts_with("!--")) continue;
    text += ends ? "\\x2f" : "\\x21";
    ++i;
  }
  return text;
}

}  // namespace

std::string view_bytes(const Expansion& expansion, const Mesh* shape, const std::string& title,
                       const Data& data, const Context& context) {
  const int degree = std::min(expansion.coefficients.degree(), kHighestDrawn);
  const std::size_t n = static_cast<std::size_t>(degree) + 1;
  const Coefficients kept = expansion.coefficients.resized(degree);
  NamedArrays arrays;
  arrays.add("coefficients", kept.values(), {2, n, n});
  if (shape != nullptr) add_shape(*shape, context, arrays);
  return arrays.bytes(meta_of(expansion, title, data));
}

std::string viewer_place() {
  return section("The surface, degree by degree", "<div id=\"rholm-view\"></div>\n");
}

std::string viewer_scripts(std::string_view bytes, std::string_view viewer) {
  return fmt::format(
      "<script type=\"application/octet-stream;base64\" id=\"rholm-data\">{}</script>\n"
      "<script type=\"module\">{}</script>\n",
      html::base64({bytes.data(), bytes.size()}), inside_script(viewer));
}

}  // namespace rholm::report

namespace rholm {

std::string view_data(const Expansion& expansion, const Mesh* shape, const std::string& title,
                      const Context& context) {
  require_surface(expansion);
  return report::view_bytes(expansion, shape, title, report::find_data(expansion, {}, context),
                            context);
}

}  // namespace rholm
