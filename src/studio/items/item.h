// One shape of a session. Layer: studio.
//
// Items never change. A step replaces an item by another one; the owner of the undo history
// keeps the old one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rholm/compress.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/shape_io.h"
#include "rholm/star.h"
#include "rholm/topology.h"
#include "studio/items/fields.h"
#include "studio/items/model.h"

namespace rholm::studio {

enum class Kind : std::uint8_t { kMesh, kPoints, kExpansion, kAtlas };
const char* to_string(Kind kind);  // "mesh", "points", "expansion", "atlas"

// Facts about a mesh.
struct MeshFacts {
  Inspection inspection;                 // inspection of the exactly welded mesh
  std::optional<StarReport> star;        // set if the mesh is closed and oriented
  std::vector<std::uint32_t> offending;  // triangles that face away from the centre
};

// Text table of which points were read; it can be read again with other columns.
struct Table {
  std::shared_ptr<const std::string> bytes;
  TableColumns told;  // meaning of its columns, as printable text
  // Its file, and the names that the first reading has in the lines of the recipe.
  std::string name, file, variable;
};

struct Item {
  int id = 0;
  std::string name;
  Kind kind = Kind::kMesh;
  std::uint64_t revision = 0;  // number of its surface, unique in a session
  std::string unit;            // unit of lengths, empty if unknown

  std::shared_ptr<const Mesh> original;     // meshes only: as read, or after the last edit
  std::shared_ptr<const Model> model;       // expansions and expanded meshes only
  std::shared_ptr<const AtlasModel> atlas;  // atlases only
  // File of the atlas, returned as is, since rewriting may change the last digits.
  std::shared_ptr<const std::string> atlas_file;
  std::shared_ptr<const PointCloud> points;  // points only
  std::shared_ptr<const Table> table;        // only for points read from a text table
  std::vector<std::string> warnings;         // warnings by the reader of its file
  std::shared_ptr<const Mesh> shown;         // the surface with its look; nullptr for points
  std::shared_ptr<const MeshFacts> facts;    // facts of `shown`, or of the original once expanded
  Look look;                                 // used with a model
  std::optional<double> volume;  // signed, of `shown`; set if `facts` are of another mesh
  std::optional<int> limit;      // degree limit of an atlas
  std::size_t caps = 0;          // caps of an atlas, or of a reconstruction
  std::string placed;            // text on how it was aligned; empty if it was not

  // Names in the lines of the recipe: files of the shape and of its coefficients
  // or caps, and their Python variables. Empty if they do not exist.
  std::string file, model_file, variable, model_variable;
};
using ItemPtr = std::shared_ptr<const Item>;

// Return an item with what its kind has from the start. The caller sets its number,
// revision, name and the names for the recipe. They throw the library's errors.
Item item_of(Mesh mesh, const Context& context);
Item item_of(PointCloud cloud);
Item item_of(Expansion expansion, const Context& context);
Item item_of(AtlasModel atlas, const Context& context);

// Returns the item with another look at the same model; only the surface changes.
Item with_look(const Item& item, const Look& look, const Context& context);

// Returns the item with caps up to a degree limit; nullopt means no limit.
Item with_limit(const Item& item, std::optional<int> limit, const Context& context);

MeshFacts facts_of(const Mesh& mesh, const Context& context);

// Returns an item as in the state, see docs/studio.md.
Json json_of(const Item& item);
// Returns rows of label and value for display.
Json facts_json(const Item& item);
// Returns Item::star of the state.
Json star_json(const Item& item);

// Returns rms_beyond() of a radius model, null for unknown figures; null for other models.
Json rms_json(const Model& model);

}  // namespace rholm::studio
