// Steps from points to surfaces and caps, and steps on caps.
#include "rholm/compress.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"
#include "studio/controls.h"
#include "studio/edits.h"
#include "studio/open.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

ItemPtr with_points(const Json& request, const Document& now) {
  ItemPtr item = item_in(request, "item", now);
  if (!item->points) throw wrong_kind(*item, "points are needed");
  return item;
}

Step orient_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_points(request, now);
  OrientOptions options;
  take_fields(request, options);
  Json step = {{"op", "orient"}, {"from", json_of(Named{item->file, item->variable})}};
  record_fields(options, step);
  return {"Orient " + item->name, true, [=, &shared](Document& document, const Context& context) {
            PointCloud cloud = *item->points;
            orient(cloud, options, context);
            Item changed = *item;
            changed.table = nullptr;  // the table has other normals, or none
            changed.points = std::make_shared<const PointCloud>(std::move(cloud));
            changed.revision = ++shared.revisions;
            record(document.recipe, changed, "-oriented", step);
            put(document, std::move(changed));
          }};
}

// Reads the table again with the given columns.
Step read_columns(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_points(request, now);
  if (!item->table)
    throw wrong_kind(*item, "points as they were read from a text table are needed");
  const std::string columns = string_of(request, "columns");
  if (columns.empty()) throw bad_request("the field 'columns' is empty");
  check_columns(columns);
  return {"Say the columns of " + item->name, false,
          [=, &shared](Document& document, const Context& context) {
            Item changed = open_table(*item->table, columns, context);
            changed.id = item->id;
            changed.name = item->name;
            changed.unit = item->unit;
            changed.revision = ++shared.revisions;
            record_columns(document.recipe, changed, columns);
            put(document, std::move(changed));
          }};
}

Step reconstruct_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = with_points(request, now);
  const ReconstructOptions options = reconstruct_in(request);
  Json step = recipe_step("reconstruct", request, {"noise", "simplify"});
  record_fields(options, step);
  step["from"] = json_of(Named{item->file, item->variable});
  return {"Reconstruct " + item->name, true,
          [=, &shared](Document& document, const Context& context) {
            Reconstruction found = reconstruct(*item->points, options, context);
            Item made = item_of(std::move(found.mesh), context);
            made.name = item->name;
            made.unit = item->unit;
            made.caps = found.report.caps;
            record(document.recipe, made, "-surface", step);
            made.name = made.file;
            add(document, std::move(made), shared);
          }};
}

// Returns the rounded model of its file, so that other programs show the same surface.
Item item_of_written(const AtlasModel& model, Scratch& scratch, const Context& context) {
  AtlasModel read;
  std::string bytes = scratch.written(".h5", [&](const std::filesystem::path& path) {
    write_atlas(model, path);
    read = read_atlas(path);
  });
  Item item = item_of(std::move(read), context);
  item.atlas_file = std::make_shared<const std::string>(std::move(bytes));
  return item;
}

// Prepares a mesh in the same way as `rholm analyze --atlas`.
Mesh prepared(const Mesh& mesh) {
  Mesh welded = weld(mesh).mesh;
  if (inspect(welded).inside_out) flip(welded);
  return welded;
}

Step compress_item(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = item_in(request, "item", now);
  if (item->atlas) throw wrong_kind(*item, "it is caps already");
  CompressOptions options;
  options.tolerance = number_of(request, "tolerance");
  take_fields(request, options);
  Json wanted = recipe_step("compress", request, {"tolerance"});
  record_fields(options, wanted);
  return {"Compress " + item->name, true, [=, &shared](Document& document, const Context& context) {
            Compressed found = item->points ? compress(*item->points, options, context)
                                            : compress(prepared(*item->shown), options, context);
            found.model.unit = item->unit;
            Item made = item_of_written(found.model, shared.scratch, context);
            Recipe& recipe = document.recipe;
            const Named from =
                item->points ? Named{item->file, item->variable} : surface_of(recipe, *item);
            made.model_file = recipe.file(stem_of(item->name) + "-caps", ".h5");
            made.model_variable = recipe.variable(stem_of(item->name) + "_caps");
            Json step = wanted;
            step["from"] = json_of(from);
            step["made"] = json_of(Named{made.model_file, made.model_variable});
            if (!item->unit.empty()) step["unit"] = item->unit;
            recipe.add(step);
            made.file = made.model_file;  // used by edits of the surface of a caps file
            made.variable = made.model_variable + ".mesh()";
            made.name = made.model_file;
            add(document, std::move(made), shared);
          }};
}

// Limits the degree of the caps; only the surface changes.
Step look_at_atlas(const Json& request, const Document& now, Shared& shared) {
  const ItemPtr item = item_in(request, "item", now);
  if (!item->atlas) throw wrong_kind(*item, "caps are needed");
  const int highest = highest_degree(item->atlas->atlas);
  const int limit = integer_of(request, "limit");
  if (limit < 0) throw bad_request("'limit' must not be negative");
  return {"Look at " + item->name, true, [=, &shared](Document& document, const Context& context) {
            const bool all = limit >= highest;
            Item changed = with_limit(*item, all ? std::nullopt : std::optional(limit), context);
            changed.revision = ++shared.revisions;
            if (all) {
              changed.file = item->model_file;
              changed.variable = item->model_variable + ".mesh()";
            } else {
              record(document.recipe, changed, "-surface",
                     {{"op", "atlas_look"},
                      {"from", json_of(Named{item->model_file, item->model_variable})},
                      {"limit", limit}});
            }
            put(document, std::move(changed));
          }};
}

}  // namespace

std::optional<Step> point_step(const std::string& op, const Json& request, const Document& now,
                               Shared& shared) {
  if (op == "columns") return read_columns(request, now, shared);
  if (op == "orient") return orient_item(request, now, shared);
  if (op == "reconstruct") return reconstruct_item(request, now, shared);
  if (op == "compress") return compress_item(request, now, shared);
  if (op == "atlas_look") return look_at_atlas(request, now, shared);
  return std::nullopt;
}

}  // namespace rholm::studio
