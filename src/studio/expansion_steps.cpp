// Steps on expansions: expand, look, align, blend.
#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "rholm/align.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/rotate.h"
#include "studio/blend.h"
#include "studio/controls.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

ItemPtr with_model(const Json& request, const char* field, const Document& now) {
  ItemPtr item = item_in(request, field, now);
  if (!item->model) throw wrong_kind(*item, "it has no expansion yet; expand it first");
  return item;
}

ExpandOptions expansion_options_in(const Json& request) {
  TransformOptions transform;
  take_fields(request, transform);
  ExpandOptions options{.degree = transform.degree,
                        .method = transform.method,
                        .engine = transform.engine,
                        .precision = transform.precision};
  if (const std::optional<double> tolerance = maybe_number(request, "tolerance")) {
    options.tolerance = Tolerance{.error = *tolerance};
  } else {
    number_of(request, "degree");  // throws: one of the two is required
  }
  options.chart.center = parse_center(string_or(request, "center", "auto"));
  return options;
}

// Returns the item's own mesh: as read, or the shown surface of a series or caps.
std::shared_ptr<const Mesh> shape_of(const Item& item) {
  return item.original ? item.original : item.shown;
}

// Returns the file and variable of that mesh.
Named shape_of(Recipe& recipe, const Item& item) {
  return item.original ? Named{item.file, item.variable} : surface_of(recipe, item);
}

Step expand_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = item_in(request, "item", now);
  if (item->points) throw wrong_kind(*item, "it has no faces; reconstruct makes a surface of it");
  const ExpandOptions options = expansion_options_in(request);
  Json wanted = recipe_step("expand", request, {"tolerance", "degree", "center"});
  record_fields(transform_options(options), wanted);
  return {"Expand " + item->name, true, [=, &shared](Document& document, const Context& context) {
            const std::shared_ptr<const Mesh> mesh = shape_of(*item);
            Expanded expanded = expand(*mesh, options, context);
            Item changed = *item;
            const Named shape = shape_of(document.recipe, *item);
            changed.file = shape.file;
            changed.variable = shape.variable;
            changed.kind = Kind::kMesh;
            changed.original = mesh;
            changed.atlas = nullptr;
            changed.atlas_file = nullptr;
            changed.caps = 0;
            changed.limit = std::nullopt;
            changed.placed.clear();
            expanded.transform.expansion.unit = item->unit;
            changed.model = make_model(std::move(expanded.transform.expansion), mesh, context);
            changed = with_look(changed, whole(*changed.model), context);
            changed.revision = ++shared.revisions;
            changed.model_file = document.recipe.file(stem_of(item->name), ".h5");
            changed.model_variable = document.recipe.variable(stem_of(item->name) + "_model");
            Json step = wanted;
            step["from"] = json_of(shape);
            step["made"] = json_of(Named{changed.model_file, changed.model_variable});
            if (!item->unit.empty()) step["unit"] = item->unit;
            document.recipe.add(step);
            put(document, std::move(changed));
          }};
}

Step look_at(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_model(request, "item", now);
  const Look look = look_in(request, *item->model);
  return {"Look at " + item->name, false, [=, &shared](Document& document, const Context& context) {
            Item changed = with_look(*item, look, context);
            changed.revision = ++shared.revisions;
            put(document, std::move(changed));
          }};
}

// Moves every point p to R M (p - from) + to, and rotates normals.
// A mirror image is flipped, so that it faces outwards again.
Mesh placed_mesh(Mesh mesh, const Placement& placement) {
  const AlignedRotation& best = placement.alignment.best;
  const auto turned = [&](Vec3 v) {
    if (best.mirrored) v.x = -v.x;
    return rotate(v, best.rotation);
  };
  for (Vec3& v : mesh.vertices) v = turned(v - placement.from) + placement.to;
  if (best.mirrored) {
    for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
  }
  Attribute* normals[3] = {};
  for (Attribute& a : mesh.attributes) {
    if (a.name == "nx") normals[0] = &a;
    if (a.name == "ny") normals[1] = &a;
    if (a.name == "nz") normals[2] = &a;
  }
  if (std::count(normals, normals + 3, nullptr) > 0) return mesh;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 n = turned({normals[0]->values[i], normals[1]->values[i], normals[2]->values[i]});
    normals[0]->values[i] = n.x;
    normals[1]->values[i] = n.y;
    normals[2]->values[i] = n.z;
  }
  return mesh;
}

// Returns "Turned by 41.2 degrees onto egg.ply: radii differ by 0.0123 (rms), before by 0.21."
std::string told_of(const Alignment& alignment, const Item& onto) {
  const AlignedRotation& best = alignment.best;
  const bool gauge = onto.model->expansion.function == RadialFunction::kGauge;
  const std::string unit = onto.unit.empty() || gauge ? "" : " " + onto.unit;
  std::string text = fmt::format(
      "{}urned by {:.1f} degrees onto {}: {} differ by {:.3g}{} (rms), before by {:.3g}{}.",
      best.mirrored ? "Mirrored and t" : "T",
      axis_angle_of(best.rotation).angle * 180 / std::numbers::pi, onto.name,
      gauge ? "inverse radii" : "radii", best.distance, unit, alignment.unaligned_distance, unit);
  if (const std::size_t n = alignment.ambiguities.size(); n > 0) {
    text += fmt::format(" {} other turn{} nearly as good.", n, n == 1 ? " is" : "s are");
  }
  if (!alignment.free_axes.empty()) text += " About an axis it may be turned at will.";
  return text;
}

void record_aligned(Recipe& recipe, const Item& a, const Item& b, const AlignOptions& options,
                    Item& moved) {
  moved.model_file = recipe.file(stem_of(a.name) + "-aligned", ".h5");
  moved.model_variable = recipe.variable(stem_of(a.name) + "_aligned");
  Json step = {{"op", "align"},
               {"a", json_of(Named{a.model_file, a.model_variable})},
               {"b", json_of(Named{b.model_file, b.model_variable})},
               {"made", json_of(Named{moved.model_file, moved.model_variable})}};
  record_fields(options, step);
  recipe.add(step);
}

Step align_items(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr a = with_model(request, "a", now), b = with_model(request, "b", now);
  AlignOptions options;
  take_fields(request, options);
  if (a == b) throw bad_request("an item is not aligned with itself: 'a' and 'b' must differ");
  return {"Align " + a->name, true, [=, &shared](Document& document, const Context& context) {
            const Expansion& before = a->model->expansion;
            const Placement placement =
                align(before, b->model->expansion, AlignCenters::kAuto, options, context);
            Expansion moved = placed(before, placement, context);
            std::shared_ptr<const Mesh> mesh;
            if (a->original) {
              mesh = std::make_shared<const Mesh>(placed_mesh(*a->original, placement));
            }
            Item changed = *a;
            changed.original = mesh;
            changed.placed = told_of(placement.alignment, *b);
            if (!placement.why_own.empty()) {
              changed.placed +=
                  " The centres of both models lie on each other, not the centroids: " +
                  placement.why_own + ".";
            }
            changed.model = make_model(std::move(moved), mesh, context);
            const Model& model = *changed.model;
            changed.facts = std::make_shared<const MeshFacts>(
                mesh ? facts_of(*mesh, context)
                     : facts_of(surface_of(model, whole(model), context), context));
            changed = with_look(changed, a->look, context);
            changed.revision = ++shared.revisions;
            record_aligned(document.recipe, *a, *b, options, changed);
            put(document, std::move(changed));
          }};
}

Step blend_items(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr a = with_model(request, "a", now), b = with_model(request, "b", now);
  const double t = number_of(request, "t");
  return {"Blend " + a->name, true, [=, &shared](Document& document, const Context& context) {
            Item made = item_of(
                blended(expansion_of(*a->model, a->look), expansion_of(*b->model, b->look), t),
                context);
            Recipe& recipe = document.recipe;
            const Named from = model_of(recipe, *a), to = model_of(recipe, *b);
            made.model_variable = recipe.variable(stem_of(a->name) + "_" + stem_of(b->name));
            made.model_file = made.model_variable + ".h5";
            made.name = made.model_file;
            const Expansion& expansion = made.model->expansion;
            recipe.add({{"op", "blend"},
                        {"a", json_of(from)},
                        {"b", json_of(to)},
                        {"t", t},
                        {"degree", expansion.coefficients.degree()},
                        {"center", {expansion.center.x, expansion.center.y, expansion.center.z}},
                        {"function", to_string(expansion.function)},
                        {"made", json_of(Named{made.model_file, made.model_variable})}});
            add(document, std::move(made), shared);
          }};
}

}  // namespace

std::optional<Step> expansion_step(const std::string& op, const Json& request, const Document& now,
                                   Shared& shared) {
  if (op == "expand") return expand_item(request, now, shared);
  if (op == "look") return look_at(request, now, shared);
  if (op == "align") return align_items(request, now, shared);
  if (op == "blend") return blend_items(request, now, shared);
  return std::nullopt;
}

}  // namespace rholm::studio
