// Steps that need no thread: shapes made, removed, renamed.
#include <fmt/format.h>

#include "rholm/points.h"
#include "rholm/primitives.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

constexpr std::size_t kMaxName = 200;  // bytes; chosen: longer ones are no names

// What is made.
struct Making {
  std::string kind;
  double amplitude = 0.2;  // of bumpy shapes, and points on them
  std::uint64_t seed = 1;
};

Making making_of(const Json& request) {
  Making making = {.kind = string_or(request, "shape", "bumpy")};
  making.amplitude = number_or(request, "amplitude", making.amplitude);
  const int seed = integer_or(request, "seed", static_cast<int>(making.seed));
  // As `rholm make` takes them.
  if (!(making.amplitude >= 0 && making.amplitude <= 0.99)) {
    throw bad_request("the field 'amplitude' must be within 0 ... 0.99");
  }
  if (seed < 0) throw bad_request("the field 'seed' must not be negative");
  making.seed = static_cast<std::uint64_t>(seed);
  return making;
}

// As `rholm make` makes them by default.
Mesh shape_of(const Making& making) {
  const std::string& kind = making.kind;
  if (kind == "bumpy" || kind == "points") return bumpy_sphere(5, making.amplitude, making.seed);
  if (kind == "sphere") return icosphere(5);
  if (kind == "ellipsoid") return ellipsoid({3, 2, 1}, 5);
  if (kind == "torus") return torus(1, 0.4, 96, 48);
  if (kind == "box") return box({1, 1, 1}, 24);
  throw bad_request("the field 'shape' must be bumpy, sphere, ellipsoid, torus, box or points");
}

// What Python calls for the same.
std::string python_of(const Making& making) {
  const std::string& kind = making.kind;
  if (kind == "sphere") return "rholm.icosphere(5)";
  if (kind == "ellipsoid") return "rholm.ellipsoid((3, 2, 1), 5)";
  if (kind == "torus") return "rholm.torus(1, 0.4, 96, 48)";
  if (kind == "box") return "rholm.box((1, 1, 1), 24)";
  const Making usual;
  std::string more;
  if (making.amplitude != usual.amplitude) more += fmt::format(", amplitude={}", making.amplitude);
  if (making.seed != usual.seed) more += fmt::format(", seed={}", making.seed);
  return "rholm.bumpy_sphere(5" + more + ")";
}

// What a shell is told for the same.
std::string shell_of(const Making& making) {
  if (making.kind == "box") return "box --cells 24";
  if (making.kind != "bumpy" && making.kind != "points") return making.kind;
  const Making usual;
  std::string words = "bumpy";
  if (making.amplitude != usual.amplitude)
    words += fmt::format(" --amplitude {}", making.amplitude);
  if (making.seed != usual.seed) words += fmt::format(" --seed {}", making.seed);
  return words;
}

constexpr int kPoints = 20000;  // chosen: a surface is made of them in a second

void record_made(Recipe& recipe, Item& item, const Making& making) {
  const bool points = making.kind == "points";
  const std::string mesh = recipe.file(points ? "bumpy" : making.kind, ".ply");
  const std::string variable = recipe.variable(stem_of(mesh));
  recipe.shell.push_back(fmt::format("rholm make {} -o {}", shell_of(making), mesh));
  recipe.python.push_back(variable + " = " + python_of(making));
  item.file = mesh;
  item.variable = variable;
  if (points) {
    item.file = recipe.file("points", ".ply");
    item.variable = recipe.variable(stem_of(item.file));
    recipe.shell.push_back(
        fmt::format("rholm make sample {} --points {} -o {}", mesh, kPoints, item.file));
    recipe.python.push_back(
        fmt::format("{} = rholm.sample_surface({}, {})", item.variable, variable, kPoints));
  }
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
  const std::string name = string_of(request, "name");
  if (name.empty() || name.size() > kMaxName) {
    throw bad_request(fmt::format("a name has 1 ... {} bytes", kMaxName));
  }
  return {"Rename " + item->name, false, [item, name](Document& document, const Context&) {
            Item changed = *item;
            changed.name = name;
            put(document, std::move(changed));
          }};
}

}  // namespace

std::optional<Step> plain_step(const std::string& op, const Json& request, const Document& now,
                               Shared& shared) {
  if (op == "make") return make(request, shared);
  if (op == "remove") return remove(request, now);
  if (op == "rename") return rename(request, now);
  return std::nullopt;
}

}  // namespace rholm::studio
