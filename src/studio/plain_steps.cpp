// Steps without a thread: make, remove, rename, set the unit.
#include "rholm/coefficients_io.h"
#include "rholm/compress.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

// Shape to make.
struct Making {
  std::string kind;
  double amplitude = 0.2;  // amplitude of bumpy shapes, and of points on them
  std::uint64_t seed = 1;
};

Making making_of(const Json& request) {
  Making making = {.kind = string_or(request, "shape", "bumpy")};
  making.amplitude = number_or(request, "amplitude", making.amplitude);
  const int seed = integer_or(request, "seed", static_cast<int>(making.seed));
  // The limits of `rholm make`.
  if (!(making.amplitude >= 0 && making.amplitude <= 0.99)) {
    throw bad_request("the field 'amplitude' must be within 0 ... 0.99");
  }
  if (seed < 0) throw bad_request("the field 'seed' must not be negative");
  making.seed = static_cast<std::uint64_t>(seed);
  return making;
}

// Makes a shape with the defaults of `rholm make`.
Mesh shape_of(const Making& making) {
  const std::string& kind = making.kind;
  if (kind == "bumpy" || kind == "points") return bumpy_sphere(5, making.amplitude, making.seed);
  if (kind == "sphere") return icosphere(5);
  if (kind == "ellipsoid") return ellipsoid({3, 2, 1}, 5);
  if (kind == "torus") return torus(1, 0.4, 96, 48);
  if (kind == "box") return box({1, 1, 1}, 24);
  throw bad_request("the field 'shape' must be bumpy, sphere, ellipsoid, torus, box or points");
}

constexpr int kPoints = 20000;  // chosen: reconstruction takes a second

void record_made(Recipe& recipe, Item& item, const Making& making) {
  const bool points = making.kind == "points";
  Named made;
  made.file = recipe.file(points ? "bumpy" : making.kind, ".ply");
  made.variable = recipe.variable(stem_of(made.file));
  Json step = {{"op", "make"}, {"shape", making.kind}, {"made", json_of(made)}};
  const Making usual;
  const bool bumpy = points || making.kind == "bumpy";
  if (bumpy && making.amplitude != usual.amplitude) step["amplitude"] = making.amplitude;
  if (bumpy && making.seed != usual.seed) step["seed"] = making.seed;
  if (points) {
    made.file = recipe.file("points", ".ply");
    made.variable = recipe.variable(stem_of(made.file));
    step["points"] = kPoints;
    step["cloud"] = json_of(made);
  }
  recipe.add(step);
  item.file = made.file;
  item.variable = made.variable;
  item.name = item.file;
}

Step make(const Json& request, Shared& shared) {
  const Making making = making_of(request);
  shape_of(making);
  return {"Make " + making.kind, false,
          [making, &shared](Document& document, const Context& context) {
            Mesh mesh = shape_of(making);
            Item item = making.kind == "points"
                            ? item_of(sample_surface(mesh, {.points = kPoints}, context))
                            : item_of(std::move(mesh), context);
            record_made(document.recipe, item, making);
            add(document, std::move(item), shared);
          }};
}

Step remove(const Json& request, const Document& now) {
  const ItemPtr item = item_in(request, "item", now);
  return {"Remove " + item->name, false,
          [item](Document& document, const Context&) { std::erase(document.items, item); }};
}

Step rename(const Json& request, const Document& now) {
  const ItemPtr item = item_in(request, "item", now);
  const std::string wanted = string_of(request, "name"), name = plain_name(wanted);
  if (name != wanted) {
    throw bad_request(
        "a name is the name of a file: 1 ... 200 bytes of letters that print, no path");
  }
  return {"Rename " + item->name, false, [item, name](Document& document, const Context&) {
            Item changed = *item;
            changed.name = name;
            put(document, std::move(changed));
          }};
}

std::shared_ptr<const Model> with_unit(const Model& model, const std::string& unit) {
  auto changed = std::make_shared<Model>(model);
  changed->expansion.unit = unit;
  return changed;
}

void set_unit(Item& item, const std::string& unit, Scratch& scratch) {
  item.unit = unit;
  if (item.model) item.model = with_unit(*item.model, unit);
  if (!item.atlas) return;
  auto atlas = std::make_shared<AtlasModel>(*item.atlas);
  atlas->unit = unit;
  item.atlas_file = std::make_shared<const std::string>(scratch.written(
      ".h5", [&](const std::filesystem::path& path) { write_atlas(*atlas, path); }));
  item.atlas = atlas;
}

// Files of shapes have no unit, so only models get a new file.
void record_unit(Recipe& recipe, Item& item) {
  if (!item.model && !item.atlas) return;
  const Named from = {item.model_file, item.model_variable};
  Named made;
  made.file = recipe.file(stem_of(from.file), ".h5");
  made.variable = recipe.variable(stem_of(made.file));
  recipe.add(
      {{"op", "unit"}, {"from", json_of(from)}, {"made", json_of(made)}, {"unit", item.unit}});
  item.model_file = made.file;
  item.model_variable = made.variable;
  if (item.atlas && item.file == from.file) {
    item.file = made.file;
    item.variable = made.variable + ".mesh()";
  }
}

// Sets the unit of lengths; the numbers stay.
Step set_unit(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = item_in(request, "item", now);
  const std::string unit = string_of(request, "unit");
  if (!unit.empty()) check_unit(unit);
  return {"Set the unit of " + item->name, false,
          [item, unit, &shared](Document& document, const Context&) {
            Item changed = *item;
            set_unit(changed, unit, shared.scratch);
            record_unit(document.recipe, changed);
            put(document, std::move(changed));
          }};
}

}  // namespace

std::optional<Step> plain_step(const std::string& op, const Json& request, const Document& now,
                               Shared& shared) {
  if (op == "make") return make(request, shared);
  if (op == "remove") return remove(request, now);
  if (op == "rename") return rename(request, now);
  if (op == "unit") return set_unit(request, now, shared);
  return std::nullopt;
}

}  // namespace rholm::studio
