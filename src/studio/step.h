// Steps: single changes of the shapes of a session. Layer: studio.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rholm/context.h"
#include "rholm/region.h"
#include "studio/items/item.h"
#include "studio/items/message.h"
#include "studio/recipe.h"
#include "studio/scratch.h"

namespace rholm::studio {

// Everything that a step may change and undoing restores; a value.
struct Document {
  std::vector<ItemPtr> items;  // oldest first
  Recipe recipe;
};

// Returns the bytes of the documents' meshes, points and tables; shared ones count once.
std::size_t bytes_of(std::span<const Document* const> documents);

// State shared by all steps of a session. Numbers
// are never given twice, even after undoing.
struct Shared {
  Scratch& scratch;
  std::atomic<int> items{0};
  std::atomic<std::uint64_t> revisions{0};
};

struct Step {
  std::string label;  // for display: "Smooth bumpy.ply"
  bool slow = false;  // true: it runs on its own thread
  // Changes its own copy of the document. Throws the library's errors.
  std::function<void(Document&, const Context&)> work;
  // If nothing can be undone yet, this step cannot be undone either: it makes a page's start.
  bool first = false;
};

// Returns the step of the request {"op": ...}. Throws Refusal 400 for an
// invalid request, 404 for a missing item, 422 for an item of the wrong kind.
Step step_of(const Json& request, const Document& now, Shared& shared);

// Return steps by the kind of data they change; nullopt for an unknown op.
std::optional<Step> plain_step(const std::string& op, const Json& request, const Document& now,
                               Shared& shared);  // make, remove, rename, unit
std::optional<Step> expansion_step(const std::string& op, const Json& request, const Document& now,
                                   Shared& shared);  // analyze, look, align, blend
std::optional<Step> edit_step(const std::string& op, const Json& request, const Document& now,
                              Shared& shared);  // smooth, transfer, simplify, repair
std::optional<Step> point_step(
    const std::string& op, const Json& request, const Document& now,
    Shared& shared);  // columns, orient, reconstruct, compress, atlas_look

// Return the item with the number `id`, or in a field. Throw Refusal 400, 404.
ItemPtr item_of(const Document& document, int id);
ItemPtr item_in(const Json& request, const char* field, const Document& document);
// Returns Refusal 422 for an item of the wrong kind.
Refusal wrong_kind(const Item& item, const std::string& needed);

// Returns the look {"degree", "gains"} of a request. Throws Refusal 400 if it is invalid.
Look look_in(const Json& request, const Model& model);
// Returns the regions in a field, or discs of "radius" around "points". Throws Refusal 400.
std::vector<std::string> regions_in(const Json& request, const char* field);
std::vector<Region> parsed(const std::vector<std::string>& regions);

// put() replaces the item of the same number; add() appends an item.
void put(Document& document, Item item);
void add(Document& document, Item item, Shared& shared);
// Returns the item with another mesh; of the other properties it keeps the name and the unit.
Item edited(const Item& item, Mesh mesh, Shared& shared, const Context& context);

// Records an edit: sets its names in the recipe, and adds the step with these names.
void record(Recipe& recipe, Item& item, const std::string& suffix, Json step);

// Returns a step of the recipe: an op with the given fields, if the request has them.
Json recipe_step(const char* op, const Json& request, std::initializer_list<const char*> fields);

}  // namespace rholm::studio
