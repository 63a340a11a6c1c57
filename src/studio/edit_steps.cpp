// Steps on surfaces: smoothed, given texture, simplified, mended.
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rholm/repair.h"
#include "rholm/simplify.h"
#include "studio/edits.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

ItemPtr with_surface(const Json& request, const char* field, const Document& now) {
  ItemPtr item = item_in(request, field, now);
  if (!item->shown) throw wrong_kind(*item, "it has no faces; reconstruct makes a surface of it");
  return item;
}

// The edited mesh in place of the item, its recipe written.
void finish(Document& document, const Item& before, Mesh mesh, const std::string& suffix,
            const std::string& shell, const std::string& python, Shared& shared,
            const Context& context) {
  Item changed = edited(before, std::move(mesh), shared, context);
  record(document.recipe, changed, suffix, shell, python);
  put(document, std::move(changed));
}

std::string region_options(const char* name, const std::vector<std::string>& regions) {
  std::string text;
  for (const std::string& region : regions) {
    text += fmt::format(" --{}{}{}", name, region.starts_with('-') ? "=" : " ", shell_word(region));
  }
  return text;
}

Step smooth_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_surface(request, "item", now);
  const SmoothWish wish = smooth_in(request);
  return {"Smooth " + item->name, true, [=, &shared](Document& document, const Context& context) {
            Mesh mesh = *item->shown;
            const Patch patch = analyze_patch(mesh, parsed(wish.regions), wish.options, context);
            apply(patch, update(patch, {.strength = wish.strength}), mesh);
            const Named from = surface_of(document.recipe, *item);
            const bool robust = wish.fitting == "robust", full = wish.strength == 1;
            const bool repair = wish.options.repair;
            const std::string shell =
                fmt::format("rholm smooth {}{} --wavelength {}{}{}{}", shell_word(from.file),
                            region_options("region", wish.regions), digits(wish.options.wavelength),
                            full ? "" : fmt::format(" --strength={}", wish.strength),
                            robust ? "" : " --fit " + wish.fitting, repair ? " --repair" : "");
            const std::string python =
                fmt::format("rholm.smooth({}, {}, {}{}{}{})", from.variable,
                            python_list(wish.regions), digits(wish.options.wavelength),
                            full ? "" : fmt::format(", strength={}", wish.strength),
                            robust ? "" : ", fitting=" + python_text(wish.fitting),
                            repair ? ", repair=True" : "");
            finish(document, *item, std::move(mesh), "-smooth", shell, python, shared, context);
          }};
}

std::string transfer_shell(const TransferWish& wish, const Named& from, const Named& to) {
  const TransferOptions& o = wish.options;
  const TransferUpdate& u = wish.update;
  std::string text = fmt::format("rholm transfer --from {}{} --to {}{}", shell_word(from.file),
                                 region_options("from-region", wish.from), shell_word(to.file),
                                 region_options("to-region", wish.to));
  if (o.from_degree != TransferOptions{}.from_degree) {
    text += fmt::format(" --from-degree {}", o.from_degree);
  }
  if (o.scale != 1) text += " --scale " + digits(o.scale);
  if (u.height != 1) text += " --height=" + digits(u.height);
  if (wish.degrees) text += " --rotate=" + digits(*wish.degrees);
  if (u.repeat) text += " --repeat";
  if (o.refine) text += " --refine";
  if (u.remove_own) text += " --remove-own";
  return text;
}

std::string transfer_python(const TransferWish& wish, const Named& from, const Named& to) {
  const TransferOptions& o = wish.options;
  const TransferUpdate& u = wish.update;
  std::string text = fmt::format("rholm.transfer({}, {}, {}, {}", from.variable,
                                 python_list(wish.from), to.variable, python_list(wish.to));
  if (o.from_degree != TransferOptions{}.from_degree) {
    text += fmt::format(", from_degree={}", o.from_degree);
  }
  if (o.scale != 1) text += ", scale=" + digits(o.scale);
  if (u.height != 1) text += ", height=" + digits(u.height);
  if (u.angle) text += ", angle=" + digits(*u.angle);
  if (u.repeat) text += ", repeat=True";
  if (o.refine) text += ", refine=True";
  if (u.remove_own) text += ", remove_own=True";
  return text + ")";
}

Step transfer_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr source = with_surface(request, "source", now);
  const ItemPtr target = with_surface(request, "target", now);
  const TransferWish wish = transfer_in(request);
  return {"Transfer to " + target->name, true,
          [=, &shared](Document& document, const Context& context) {
            Mesh mesh = transfer(*source->shown, parsed(wish.from), *target->shown, parsed(wish.to),
                                 wish.options, wish.update, context);
            const Named from = surface_of(document.recipe, *source);
            const Named to = source == target ? from : surface_of(document.recipe, *target);
            finish(document, *target, std::move(mesh), "-transfer", transfer_shell(wish, from, to),
                   transfer_python(wish, from, to), shared, context);
          }};
}

Step simplify_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_surface(request, "item", now);
  const std::optional<double> error = maybe_number(request, "error");
  const int faces = integer_or(request, "faces", 0);
  if (error ? !(*error > 0) : faces < 1) {
    throw bad_request("simplify needs 'faces' of at least 1, or an 'error' above 0");
  }
  return {"Simplify " + item->name, true, [=, &shared](Document& document, const Context& context) {
            SimplifyOptions options;
            if (error) options.max_error = *error;
            if (faces > 0) options.triangles = static_cast<std::size_t>(faces);
            Mesh mesh = simplify(*item->shown, options, context).mesh;
            const Named from = surface_of(document.recipe, *item);
            std::string shell = "rholm simplify " + shell_word(from.file);
            std::vector<std::string> python = {from.variable};
            if (faces > 0) {
              shell += fmt::format(" --faces {}", faces);
              python.push_back(fmt::format("triangles={}", faces));
            }
            if (error) {
              shell += " --max-error " + digits(*error);
              python.push_back("max_error=" + digits(*error));
            }
            finish(document, *item, std::move(mesh), "-simple", shell,
                   fmt::format("rholm.simplify({}).mesh", fmt::join(python, ", ")), shared,
                   context);
          }};
}

Step repair_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_surface(request, "item", now);
  return {"Repair " + item->name, true, [=, &shared](Document& document, const Context& context) {
            Mesh mesh = repair(*item->shown, {}, context).mesh;
            const Named from = surface_of(document.recipe, *item);
            finish(document, *item, std::move(mesh), "-repaired",
                   "rholm repair " + shell_word(from.file),
                   fmt::format("rholm.repair({}).mesh", from.variable), shared, context);
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
