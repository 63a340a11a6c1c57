#include "studio/step.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "rholm/region.h"

namespace rholm::studio {
namespace {

std::size_t attribute_bytes(const std::vector<Attribute>& attributes) {
  std::size_t bytes = 0;
  for (const Attribute& a : attributes) bytes += sizeof(double) * a.values.size();
  return bytes;
}

std::size_t bytes_of(const Mesh& mesh) {
  return sizeof(Vec3) * mesh.vertices.size() + sizeof(Triangle) * mesh.faces.size() +
         attribute_bytes(mesh.attributes);
}

std::size_t bytes_of(const Model& model) {
  const std::size_t table =
      model.table ? (model.table->degree() + std::size_t{1}) * model.table->directions() : 0;
  return bytes_of(model.directions) + sizeof(Triangle) * model.joined.size() +
         sizeof(float) * table + sizeof(double) * model.base.size() +
         sizeof(double) * model.expansion.coefficients.values().size();
}

std::size_t bytes_of(const PointCloud& cloud) {
  return sizeof(Vec3) * (cloud.points.size() + cloud.normals.size()) +
         attribute_bytes(cloud.attributes);
}

std::size_t bytes_of(const std::string& bytes) { return bytes.size(); }

}  // namespace

std::size_t bytes_of(std::span<const Document* const> documents) {
  std::set<const void*> seen;
  std::size_t bytes = 0;
  const auto count = [&](const auto& thing) {
    if (thing && seen.insert(thing.get()).second) bytes += bytes_of(*thing);
  };
  for (const Document* document : documents) {
    for (const ItemPtr& item : document->items) {
      count(item->original);
      count(item->shown);
      count(item->model);
      count(item->points);
      if (item->table) count(item->table->bytes);
    }
  }
  return bytes;
}

Step step_of(const Json& request, const Document& now, Shared& shared) {
  const std::string op = string_of(request, "op");
  for (const auto make : {plain_step, expansion_step, edit_step, point_step}) {
    if (std::optional<Step> step = make(op, request, now, shared)) return *std::move(step);
  }
  throw bad_request(fmt::format("there is no op '{}'", op));
}

ItemPtr item_of(const Document& document, int id) {
  const auto found = std::find_if(document.items.begin(), document.items.end(),
                                  [&](const ItemPtr& item) { return item->id == id; });
  if (found == document.items.end()) throw not_found(fmt::format("there is no item {}", id));
  return *found;
}

ItemPtr item_in(const Json& request, const char* field, const Document& document) {
  return item_of(document, integer_of(request, field));
}

Refusal wrong_kind(const Item& item, const std::string& needed) {
  return {422, "wrong_kind",
          fmt::format("{} is of the kind {}: {}", item.name, to_string(item.kind), needed)};
}

Look look_in(const Json& request, const Model& model) {
  const int highest = model.expansion.coefficients.degree();
  Look look = {.degree = integer_or(request, "degree", highest),
               .gains = numbers_of(request, "gains")};
  if (look.degree < 0 || look.degree > highest) {
    throw bad_request(
        fmt::format("the degree must be within 0 ... {}, not {}", highest, look.degree));
  }
  if (look.gains.size() > look.degree + std::size_t{1}) {
    throw bad_request(fmt::format("{} gains for degree {}: there are {} degrees", look.gains.size(),
                                  look.degree, look.degree + 1));
  }
  return look;
}

std::vector<std::string> regions_in(const Json& request, const char* field) {
  std::vector<std::string> regions = strings_of(request, field);
  if (!request.contains("points") || !regions.empty()) {
    if (regions.empty()) throw bad_request(fmt::format("the field '{}' has no region", field));
    return regions;
  }
  const double radius = number_of(request, "radius");
  for (const double vertex : numbers_of(request, "points")) {
    regions.push_back(fmt::format("vertex:{},{}", vertex, radius));
  }
  if (regions.empty()) throw bad_request("the field 'points' has no point");
  return regions;
}

std::vector<Region> parsed(const std::vector<std::string>& regions) {
  std::vector<Region> all;
  all.reserve(regions.size());
  for (const std::string& text : regions) {
    if (plain_text(text) != text) throw bad_request("a region is text that prints");
    all.push_back(parse_region(text));
  }
  return all;
}

void put(Document& document, Item item) {
  const auto place = std::find_if(document.items.begin(), document.items.end(),
                                  [&](const ItemPtr& old) { return old->id == item.id; });
  *place = std::make_shared<const Item>(std::move(item));
}

void add(Document& document, Item item, Shared& shared) {
  item.id = ++shared.items;
  item.revision = ++shared.revisions;
  document.items.push_back(std::make_shared<const Item>(std::move(item)));
}

Item edited(const Item& item, Mesh mesh, Shared& shared, const Context& context) {
  Item changed = item_of(std::move(mesh), context);
  changed.id = item.id;
  changed.name = item.name;
  changed.unit = item.unit;
  changed.revision = ++shared.revisions;
  return changed;
}

void record(Recipe& recipe, Item& item, const std::string& suffix, Json step) {
  item.file = recipe.file(stem_of(item.name) + suffix, ".ply");
  item.variable = recipe.variable(stem_of(item.file));
  step["made"] = json_of(Named{item.file, item.variable});
  recipe.add(step);
}

Json recipe_step(const char* op, const Json& request, std::initializer_list<const char*> fields) {
  Json step = {{"op", op}};
  for (const char* field : fields) {
    if (request.contains(field)) step[field] = request.at(field);
  }
  return step;
}

}  // namespace rholm::studio
