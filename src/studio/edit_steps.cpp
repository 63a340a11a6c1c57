// Steps on surfaces: smooth, transfer texture, simplify, repair.
#include "rholm/repair.h"
#include "rholm/simplify.h"
#include "studio/controls.h"
#include "studio/edits.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

ItemPtr with_surface(const Json& request, const char* field, const Document& now) {
  ItemPtr item = item_in(request, field, now);
  if (!item->shown) throw wrong_kind(*item, "it has no faces; reconstruct makes a surface of it");
  return item;
}

// Replaces the item by the edited mesh, and adds the step to the recipe.
void finish(Document& document, const Item& before, Mesh mesh, const std::string& suffix, Json step,
            Shared& shared, const Context& context) {
  Item changed = edited(before, std::move(mesh), shared, context);
  record(document.recipe, changed, suffix, std::move(step));
  put(document, std::move(changed));
}

// Returns the step with the surface it is applied to.
Json of_surface(Json step, const char* field, const Named& surface) {
  step[field] = json_of(surface);
  return step;
}

Step smooth_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_surface(request, "item", now);
  const SmoothWish wish = smooth_in(request);
  Json step = recipe_step("smooth", request, {"strength"});
  step["regions"] = wish.regions;
  record_fields(wish.options, step);
  return {"Smooth " + item->name, true, [=, &shared](Document& document, const Context& context) {
            Mesh mesh = *item->shown;
            const Patch patch = analyze_patch(mesh, parsed(wish.regions), wish.options, context);
            apply(patch, update(patch, {.strength = wish.strength}), mesh);
            const Named from = surface_of(document.recipe, *item);
            finish(document, *item, std::move(mesh), "-smooth", of_surface(step, "from", from),
                   shared, context);
          }};
}

Step transfer_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr source = with_surface(request, "source", now);
  const ItemPtr target = with_surface(request, "target", now);
  const TransferWish wish = transfer_in(request);
  Json step = recipe_step("transfer", request, {"from", "to", "angle"});
  record_fields(wish.options, step);
  record_fields(wish.update, step);
  return {"Transfer to " + target->name, true,
          [=, &shared](Document& document, const Context& context) {
            Mesh mesh = transfer(*source->shown, parsed(wish.from), *target->shown, parsed(wish.to),
                                 wish.options, wish.update, context);
            const Named from = surface_of(document.recipe, *source);
            const Named to = source == target ? from : surface_of(document.recipe, *target);
            finish(document, *target, std::move(mesh), "-transfer",
                   of_surface(of_surface(step, "source", from), "target", to), shared, context);
          }};
}

Step simplify_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_surface(request, "item", now);
  const std::optional<double> error = maybe_number(request, "error");
  const int faces = integer_or(request, "faces", 0);
  if (error ? !(*error > 0) : faces < 1) {
    throw bad_request("simplify needs 'faces' of at least 1, or an 'error' above 0");
  }
  const Json step = recipe_step("simplify", request, {"error", "faces"});
  return {"Simplify " + item->name, true, [=, &shared](Document& document, const Context& context) {
            SimplifyOptions options;
            if (error) options.max_error = *error;
            if (faces > 0) options.faces = static_cast<std::size_t>(faces);
            Mesh mesh = simplify(*item->shown, options, context).mesh;
            const Named from = surface_of(document.recipe, *item);
            finish(document, *item, std::move(mesh), "-simple", of_surface(step, "from", from),
                   shared, context);
          }};
}

Step repair_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_surface(request, "item", now);
  RepairOptions options;
  take_fields(request, options);
  Json step = {{"op", "repair"}};
  record_fields(options, step);
  return {"Repair " + item->name, true, [=, &shared](Document& document, const Context& context) {
            Mesh mesh = repair(*item->shown, options, context).mesh;
            const Named from = surface_of(document.recipe, *item);
            finish(document, *item, std::move(mesh), "-repaired", of_surface(step, "from", from),
                   shared, context);
          }};
}

}  // namespace

std::optional<Step> edit_step(const std::string& op, const Json& request, const Document& now,
                              Shared& shared) {
  if (op == "smooth") return smooth_item(request, now, shared);
  if (op == "transfer") return transfer_item(request, now, shared);
  if (op == "simplify") return simplify_item(request, now, shared);
  if (op == "repair") return repair_item(request, now, shared);
  return std::nullopt;
}

}  // namespace rholm::studio
