#include "studio/live.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/field_text.h"
#include "rholm/harmonic.h"
#include "studio/blend.h"
#include "studio/edits.h"
#include "studio/items/arrays.h"
#include "studio/items/binary.h"

namespace rholm::studio {
namespace {

ItemPtr item_with_mesh(const Json& request, const char* field, const Document& document) {
  ItemPtr item = item_in(request, field, document);
  if (!item->shown) throw wrong_kind(*item, "it has no faces");
  return item;
}

ItemPtr item_with_model(const Json& request, const char* field, const Document& document) {
  ItemPtr item = item_in(request, field, document);
  if (!item->model) throw wrong_kind(*item, "it has no expansion yet; expand it first");
  return item;
}

Json meta_of(const Item& item) { return {{"item", item.id}, {"revision", item.revision}}; }

// Returns some vertices with their new positions.
Response moved_answer(const Item& item, const Patch& patch, const std::vector<Vec3>& positions) {
  Binary binary;
  binary.add("indices", patch.vertices, {patch.vertices.size()});
  binary.add("positions", floats_of(positions), {positions.size(), 3});
  binary.meta = meta_of(item);
  binary.meta["caps"] = patch.caps;
  binary.meta["unreached"] = patch.unreached;
  return binary.response();
}

// Returns a whole mesh, for edits that change the vertices of the item.
Response mesh_answer(const Item& item, const Mesh& mesh) {
  const std::vector<float> positions = floats_of(mesh.vertices);
  const std::size_t n = mesh.vertices.size();
  Binary binary;
  binary.add("positions", positions, {n, 3});
  binary.add("normals", normals_of(positions, mesh.faces, joined_triangles(mesh)), {n, 3});
  binary.add("triangles", indices_of(mesh.faces), {mesh.faces.size(), 3});
  binary.meta = meta_of(item);
  return binary.response();
}

}  // namespace

Response Live::answer(const Json& request, const Document& document) {
  const std::string name = string_of(request, "live");
  if (name != "degree" && name != "brush" && name != "smooth" && name != "transfer" &&
      name != "blend") {
    throw bad_request(fmt::format("there is no live look '{}'", name));
  }
  Kind* kind = nullptr;
  {
    const std::lock_guard lock(mutex_);
    kind = &kinds_[name];
  }
  const std::uint64_t ticket = ++kind->newest;
  const std::lock_guard lock(kind->working);
  if (ticket != kind->newest) throw Refusal(409, "superseded", "a newer request has come");
  if (name == "degree") return degree(request, document);
  if (name == "brush") return brush(request, document);
  if (name == "smooth") return smooth(request, document);
  if (name == "transfer") return transfer(request, document);
  return blend(request, document);
}

Response Live::degree(const Json& request, const Document& document) const {
  const ItemPtr item = item_with_model(request, "item", document);
  const QuickSurface surface =
      quick_surface(*item->model, look_in(request, *item->model), context());
  const std::size_t n = surface.positions.size() / 3;
  Binary binary;
  binary.add("positions", surface.positions, {n, 3});
  binary.add("normals", surface.normals, {n, 3});
  if (flag_of(request, "error") && !surface.error.empty()) binary.add("error", surface.error, {n});
  binary.meta = meta_of(*item);
  return binary.response();
}

// Weights fall to 0 over half the radius, unless a wavelength is given.
Response Live::brush(const Json& request, const Document& document) const {
  const ItemPtr item = item_with_mesh(request, "item", document);
  const std::vector<Region> regions = parsed(regions_in(request, "regions"));
  const double transition = request.contains("wavelength") ? number_of(request, "wavelength")
                            : request.contains("radius")   ? number_of(request, "radius") / 2
                                                           : 0.0;
  const std::vector<double> weights = region_weights(*item->shown, regions, transition);
  std::vector<std::uint32_t> indices;
  std::vector<float> values;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    indices.push_back(static_cast<std::uint32_t>(i));
    values.push_back(static_cast<float>(weights[i]));
  }
  Binary binary;
  binary.add("indices", indices, {indices.size()});
  binary.add("weights", values, {values.size()});
  binary.meta = meta_of(*item);
  return binary.response();
}

Response Live::smooth(const Json& request, const Document& document) {
  const ItemPtr item = item_with_mesh(request, "item", document);
  const SmoothWish wish = smooth_in(request);
  const double wavelength = wish.options.wavelength;
  PatchOptions others = wish.options;
  others.wavelength = 0;
  const std::string key =
      fmt::format("{} / {}", fmt::join(wish.regions, " "), text_of_fields(others));
  const bool usable = patch_.analysis && patch_.key == key && patch_.of[0] == item->shown &&
                      wavelength >= patch_.analysis->wavelength &&
                      wavelength <= longest_wavelength(*patch_.analysis);
  if (!usable) {
    patch_ = {};
    patch_.analysis = std::make_shared<const Patch>(
        analyze_patch(*item->shown, parsed(wish.regions), wish.options, context()));
    patch_.key = key;
    patch_.of[0] = item->shown;
  }
  const Patch& patch = *patch_.analysis;
  return moved_answer(*item, patch,
                      update(patch, {.wavelength = wavelength, .strength = wish.strength}));
}

Response Live::transfer(const Json& request, const Document& document) {
  const ItemPtr source = item_with_mesh(request, "source", document);
  const ItemPtr target = item_with_mesh(request, "target", document);
  TransferWish wish = transfer_in(request);
  // If the angle is given, its slow search is skipped.
  wish.options.find_angle = !wish.update.angle;
  const std::string of_source =
      fmt::format("{} / {}", fmt::join(wish.from, " "), wish.options.from_degree);
  if (!source_.analysis || source_.key != of_source || source_.of[0] != source->shown) {
    source_ = {};
    source_.analysis = std::make_shared<const TransferSource>(
        analyze_source(*source->shown, parsed(wish.from), wish.options.from_degree, context()));
    source_.key = of_source;
    source_.of[0] = source->shown;
  }
  TransferOptions others = wish.options;
  others.find_angle = false;
  const std::string key =
      fmt::format("{} / {} / {}", of_source, fmt::join(wish.to, " "), text_of_fields(others));
  const bool knows = !wish.options.find_angle || transfer_angle_;
  const bool usable = knows && transfer_.analysis && transfer_.key == key &&
                      transfer_.of[0] == source->shown && transfer_.of[1] == target->shown;
  if (!usable) {
    transfer_ = {};
    transfer_.analysis = std::make_shared<const TransferAnalysis>(analyze_transfer(
        *source_.analysis, *target->shown, parsed(wish.to), wish.options, context()));
    transfer_.key = key;
    transfer_angle_ = wish.options.find_angle;
    transfer_.of[0] = source->shown;
    transfer_.of[1] = target->shown;
  }
  const TransferAnalysis& analysis = *transfer_.analysis;
  const std::vector<Vec3> positions = update(analysis, wish.update);
  if (!wish.options.refine) return moved_answer(*target, analysis.patch, positions);
  Mesh mesh = analysis.mesh;
  apply(analysis.patch, positions, mesh);
  return mesh_answer(*target, mesh);
}

// Blends at the directions of a, whatever the directions of b are.
Response Live::blend(const Json& request, const Document& document) const {
  const ItemPtr a = item_with_model(request, "a", document);
  const ItemPtr b = item_with_model(request, "b", document);
  const Expansion blend = blended(expansion_of(*a->model, a->look),
                                  expansion_of(*b->model, b->look), number_of(request, "t"));
  const Mesh& sphere = a->model->directions;
  const std::vector<double> values =
      evaluate(blend.coefficients, sphere.vertices, {.precision = 1e-6}, context());
  const bool gauge = blend.function == RadialFunction::kGauge;
  std::vector<Vec3> points;
  points.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    points.push_back(blend.center + (gauge ? 1 / values[i] : values[i]) * sphere.vertices[i]);
  }
  const std::vector<float> positions = floats_of(points);
  Binary binary;
  binary.add("positions", positions, {points.size(), 3});
  binary.add("normals", normals_of(positions, sphere.faces, a->model->joined), {points.size(), 3});
  binary.meta = meta_of(*a);
  return binary.response();
}

}  // namespace rholm::studio
