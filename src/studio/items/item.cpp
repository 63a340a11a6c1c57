#include "studio/items/item.h"

namespace rholm::studio {

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::kMesh:
      return "mesh";
    case Kind::kPoints:
      return "points";
    case Kind::kExpansion:
      return "expansion";
    case Kind::kAtlas:
      return "atlas";
  }
  return "";
}

Item item_of(Mesh mesh, const Context& context) {
  validate(mesh);
  Item item;
  item.original = std::make_shared<const Mesh>(std::move(mesh));
  item.shown = item.original;
  item.facts = std::make_shared<const MeshFacts>(facts_of(*item.shown, context));
  return item;
}

Item item_of(PointCloud cloud) {
  validate(cloud);
  Item item;
  item.kind = Kind::kPoints;
  item.points = std::make_shared<const PointCloud>(std::move(cloud));
  return item;
}

Item item_of(Expansion expansion, const Context& context) {
  Item item;
  item.kind = Kind::kExpansion;
  item.unit = expansion.unit;
  item.model = make_model(std::move(expansion), nullptr, context);
  item.look = whole(*item.model);
  item.shown = std::make_shared<const Mesh>(surface_of(*item.model, item.look, context));
  item.facts = std::make_shared<const MeshFacts>(facts_of(*item.shown, context));
  return item;
}

Item item_of(AtlasModel atlas, const Context& context) {
  Item item;
  item.kind = Kind::kAtlas;
  item.unit = atlas.unit;
  item.caps = atlas.atlas.caps.size();
  item.shown = std::make_shared<const Mesh>(synthesize(atlas, {}, context));
  item.atlas = std::make_shared<const AtlasModel>(std::move(atlas));
  item.facts = std::make_shared<const MeshFacts>(facts_of(*item.shown, context));
  return item;
}

Item with_look(const Item& item, const Look& look, const Context& context) {
  Item changed = item;
  changed.look = look;
  changed.shown = std::make_shared<const Mesh>(surface_of(*item.model, look, context));
  changed.volume = enclosed_volume(*changed.shown);
  return changed;
}

Item with_limit(const Item& item, std::optional<int> limit, const Context& context) {
  Item changed = item;
  changed.limit = limit;
  changed.shown = std::make_shared<const Mesh>(synthesize(*item.atlas, {.degree = limit}, context));
  changed.facts = std::make_shared<const MeshFacts>(facts_of(*changed.shown, context));
  return changed;
}

}  // namespace rholm::studio
