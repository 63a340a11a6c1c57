// One shape of a session. Layer: studio.
//
// Items never change: a step puts another one in the place of an item, and what was there is kept
// by who can undo the step.
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

// What is known of a mesh.
struct MeshFacts {
  Inspection inspection;                 // of the mesh welded exactly
  std::optional<StarReport> star;        // of one that is closed and oriented
  std::vector<std::uint32_t> offending;  // triangles that turn their back to its centre
};

// The text table that points were read from, so that it can be read in another way.
struct Table {
  std::shared_ptr<const std::string> bytes;
  TableColumns told;  // what its columns were taken for, as text that prints
  // Its file, and where the lines of the recipe have what was read of it first.
  std::string name, file, variable;
};

struct Item {
  int id = 0;
  std::string name;
  Kind kind = Kind::kMesh;
  std::uint64_t revision = 0;  // of its surface: two surfaces of a session never have the same
  std::string unit;            // of lengths, empty if unknown

  std::shared_ptr<const Mesh> original;     // of meshes: as read, or as the last edit left it
  std::shared_ptr<const Model> model;       // of expansions, and meshes that were analysed
  std::shared_ptr<const AtlasModel> atlas;  // of atlases
  // Its file. What was read and written again may have other last digits: this is given back.
  std::shared_ptr<const std::string> atlas_file;
  std::shared_ptr<const PointCloud> points;  // of points
  std::shared_ptr<const Table> table;        // of points as a table of text has them
  std::vector<std::string> warnings;         // of the reader of its file
  std::shared_ptr<const Mesh> shown;         // the surface with its look; nullptr for points
  std::shared_ptr<const MeshFacts> facts;    // of `shown`, or of the original if it was analysed
  Look look;                                 // with a model
  std::optional<double> volume;  // signed, of `shown`, where that is not what `facts` are of
  std::optional<int> limit;      // of the degree of the caps of an atlas
  std::size_t caps = 0;          // of an atlas, or of a reconstruction
  std::string placed;            // how it was laid on another one, for people; empty if it was not

  // Where the lines of the recipe have it: the file of the shape and that of its coefficients or
  // caps, the variable of Python of each. Empty if there is none.
  std::string file, model_file, variable, model_variable;
};
using ItemPtr = std::shared_ptr<const Item>;

// What every item of its kind has from the start; who calls gives it a number, a revision, its name
// and names for the recipe. Throw what the library throws.
Item item_of(Mesh mesh, const Context& context);
Item item_of(PointCloud cloud);
Item item_of(Expansion expansion, const Context& context);
Item item_of(AtlasModel atlas, const Context& context);

// Another look at the same model: the surface, and nothing else, is new.
Item with_look(const Item& item, const Look& look, const Context& context);

// The same caps with no higher degrees; none: all of them.
Item with_limit(const Item& item, std::optional<int> limit, const Context& context);

MeshFacts facts_of(const Mesh& mesh, const Context& context);

// As in the state, see docs/studio.md.
Json json_of(const Item& item);
// Rows of label and value for people.
Json facts_json(const Item& item);
// Of Item::star in the state.
Json star_json(const Item& item);

// rms_beyond() of a model of the radius: a list, null where a figure is not known; null for others.
Json rms_json(const Model& model);

}  // namespace rholm::studio
