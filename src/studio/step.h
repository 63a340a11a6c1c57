// What can be done to the shapes of a session, one thing at a time. Layer: studio.
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

// All that a step may change, and that undoing brings back: a value.
struct Document {
  std::vector<ItemPtr> items;  // oldest first
  Recipe recipe;
};

// Bytes of the meshes, points and tables of documents, each once whoever shares it.
std::size_t bytes_of(std::span<const Document* const> documents);

// What all steps of a session share. Numbers that were given once are not given again, whatever is
// undone.
struct Shared {
  Scratch& scratch;
  std::atomic<int> items{0};
  std::atomic<std::uint64_t> revisions{0};
};

struct Step {
  std::string label;  // for people: "Smooth bumpy.ply"
  bool slow = false;  // worth a thread of its own
  // Changes its own copy of the document. Throws what the library throws.
  std::function<void(Document&, const Context&)> work;
  // Where nothing can be undone yet, this cannot either: what it makes is what a page begins with.
  bool first = false;
};

// What the request {"op": ...} asks for. Throws Refusal 400 for a request that is wrong as it
// stands, 404 for an item that is not there, 422 for one of the wrong kind.
Step step_of(const Json& request, const Document& now, Shared& shared);

// Steps by what they work on; each gives none for an op that it does not know.
std::optional<Step> plain_step(const std::string& op, const Json& request, const Document& now,
                               Shared& shared);  // make, remove, rename
std::optional<Step> expansion_step(const std::string& op, const Json& request, const Document& now,
                                   Shared& shared);  // analyze, look, align, blend
std::optional<Step> edit_step(const std::string& op, const Json& request, const Document& now,
                              Shared& shared);  // smooth, transfer, simplify, repair
std::optional<Step> point_step(
    const std::string& op, const Json& request, const Document& now,
    Shared& shared);  // columns, orient, reconstruct, compress, atlas_look

// The item with the number that stands in a field. Throws Refusal 400, 404.
ItemPtr item_of(const Document& document, int id);
ItemPtr item_in(const Json& request, const char* field, const Document& document);
// Refusal 422: the item is of the wrong kind for that.
Refusal wrong_kind(const Item& item, const std::string& needed);

// The look {"degree", "gains"} of a request. Throws Refusal 400 for one that the model has not.
Look look_in(const Json& request, const Model& model);
// The texts of regions in a field, or discs of "radius" around "points". Throws Refusal 400.
std::vector<std::string> regions_in(const Json& request, const char* field);
std::vector<Region> parsed(const std::vector<std::string>& regions);

// In place of the item of the same number, and behind all others.
void put(Document& document, Item item);
void add(Document& document, Item item, Shared& shared);
// The item with another mesh and nothing else known of it but its name.
Item edited(const Item& item, Mesh mesh, Shared& shared, const Context& context);

// The result of an edit: its names in the recipe, which has the step with them.
void record(Recipe& recipe, Item& item, const std::string& suffix, Json step);

// A step of the recipe: an op with those fields of its request that are there.
Json recipe_step(const char* op, const Json& request, std::initializer_list<const char*> fields);

}  // namespace rholm::studio
