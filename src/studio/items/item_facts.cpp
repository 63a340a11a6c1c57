// Determines facts about a mesh when it is opened, and formats them.
#include <fmt/format.h>

#include <cmath>

#include "rholm/atlas.h"
#include "studio/items/item.h"
#include "studio/items/model.h"

namespace rholm::studio {
namespace {

// Returns a number in groups of digits, like "24 503".
std::string grouped(std::size_t n) {
  std::string text = std::to_string(n);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), " ");
  }
  return text;
}

std::string length(double value, const std::string& unit) {
  return fmt::format("{:.5g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::vector<std::uint32_t> offending_triangles(const Mesh& mesh, const Vec3& center) {
  std::vector<std::uint32_t> offending;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const Triangle& corners = mesh.faces[t];
    const Vec3& a = mesh.vertices[corners[0]];
    const Vec3 normal = cross(mesh.vertices[corners[1]] - a, mesh.vertices[corners[2]] - a);
    if (dot(normal, normal) > 0 && dot(normal, a - center) <= 0) {
      offending.push_back(static_cast<std::uint32_t>(t));
    }
  }
  return offending;
}

void add(Json& facts, const char* label, const std::string& value) {
  facts.push_back({{"label", label}, {"value", value}});
}

void add_mesh_facts(const Item& item, Json& facts) {
  const Inspection& found = item.facts->inspection;
  add(facts, "Vertices", grouped(item.shown->vertices.size()));
  add(facts, "Faces", grouped(item.shown->faces.size()));
  add(facts, "Diagonal", length(bounds(item.shown->vertices).diagonal(), item.unit));
  add(facts, "Closed",
      found.closed ? "yes" : fmt::format("no, {} open edges", grouped(found.boundary_edges)));
  if (found.components > 1) add(facts, "Parts", grouped(found.components));
  if (found.closed && found.manifold && found.genus > 0) {
    add(facts, "Handles", grouped(found.genus));
  }
  // The surface of a signed sum is not the surface of the body.
  const bool of_sum = item.model && !item.model->original && item.model->expansion.signed_sum;
  if (found.closed && found.oriented) {
    const double volume = item.volume.value_or(found.volume);
    const std::string cubed = item.unit.empty() ? "" : " " + item.unit + "\u00b3";
    add(facts, "Volume", of_sum ? "not known" : fmt::format("{:.5g}{}", std::abs(volume), cubed));
  }
  if (item.facts->star) add(facts, "Star-shaped", item.facts->star->star_shaped ? "yes" : "no");
}

// Returns "8 of 32" if not everything is shown.
std::string part(std::size_t shown, std::size_t all) {
  return shown == all ? grouped(all) : grouped(shown) + " of " + grouped(all);
}

// Adds facts about the shown part of the model.
void add_model_facts(const Item& item, Json& facts) {
  const Expansion& expansion = item.model->expansion;
  const auto all = static_cast<std::size_t>(expansion.coefficients.degree());
  const auto shown = static_cast<std::size_t>(item.look.degree);
  const bool filtered = !item.look.gains.empty();
  add(facts, "Degree", part(shown, all) + (filtered ? ", filtered" : ""));
  add(facts, "Coefficients", part((shown + 1) * (shown + 1), (all + 1) * (all + 1)));
  const Vec3& c = expansion.center;
  const std::string unit = item.unit.empty() ? "" : " " + item.unit;
  add(facts, "Centre", fmt::format("{:.4g}, {:.4g}, {:.4g}{}", c.x, c.y, c.z, unit));
  const std::optional<double> rms = filtered ? std::nullopt : rms_at(*item.model, item.look.degree);
  add(facts, "Error, rms", rms ? length(*rms, item.unit) : "not known");
}

void add_atlas_facts(const Item& item, Json& facts) {
  const AtlasSize size = size_of(item.atlas->atlas);
  add(facts, "Caps", grouped(size.caps));
  add(facts, "Numbers", grouped(size.numbers()));
  const auto highest = static_cast<std::size_t>(highest_degree(item.atlas->atlas));
  add(facts, "Highest degree",
      part(static_cast<std::size_t>(item.limit.value_or(highest)), highest));
  // The errors were measured with all degrees.
  const auto& errors = item.atlas->errors;
  const bool known = errors && !item.limit;
  add(facts, "Error, rms", known ? length(errors->rms(), item.unit) : "not known");
  add(facts, "Error, largest", known ? length(errors->max(), item.unit) : "not known");
}

std::string why_not(const Item& item) {
  const StarReport& star = *item.facts->star;
  if (star.star_shaped) return "Every point of the surface is seen once from the centre.";
  std::string text;
  if (const std::size_t n = item.facts->offending.size(); n > 0) {
    text = fmt::format("{} not seen from the best centre. ",
                       n == 1 ? "1 face is" : grouped(n) + " faces are");
  }
  if (star.rays > 0 && star.once_share < 1) {
    // Rounded down, so that nearly all is not shown as 100 %.
    text += fmt::format(
        "{:.1f} % of the directions from it meet the surface exactly once; all of them "
        "should. ",
        std::floor(1000 * star.once_share) / 10);
  }
  return item.atlas ? text : text + "Caps take shapes of any kind.";
}

}  // namespace

MeshFacts facts_of(const Mesh& mesh, const Context& context) {
  MeshFacts facts;
  const Welded welded = weld(mesh);
  facts.inspection = inspect(welded.mesh);
  const Inspection& found = facts.inspection;
  if (!found.closed || !found.oriented || found.inside_out || !(found.area > 0)) return facts;
  facts.star = find_center(welded.mesh, {}, context);
  if (!facts.star->star_shaped) facts.offending = offending_triangles(mesh, facts.star->center);
  return facts;
}

Json facts_json(const Item& item) {
  Json facts = Json::array();
  if (item.kind == Kind::kPoints) {
    add(facts, "Points", grouped(item.points->points.size()));
    add(facts, "Diagonal", length(bounds(item.points->points).diagonal(), item.unit));
    add(facts, "Normals", item.points->normals.empty() ? "none" : "yes");
    return facts;
  }
  if (item.atlas) add_atlas_facts(item, facts);
  add_mesh_facts(item, facts);
  if (item.model) add_model_facts(item, facts);
  return facts;
}

Json star_json(const Item& item) {
  if (!item.facts || !item.facts->star) return nullptr;
  const StarReport& star = *item.facts->star;
  return {{"star_shaped", star.star_shaped},
          {"center", {star.center.x, star.center.y, star.center.z}},
          {"visible", star.rays > 0 ? Json(star.once_share) : Json(nullptr)},
          {"offending", item.facts->offending.size()},
          {"why", why_not(item)}};
}

}  // namespace rholm::studio
