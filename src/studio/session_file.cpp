#include "studio/session_file.h"

#include <cstring>

#include <fmt/format.h>

#include "base/crc32.h"
#include "rholm/coefficients_io.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/shape_io.h"
#include "studio/names.h"
#include "studio/open.h"

namespace rholm::studio {
namespace {

constexpr std::string_view kMagic = "RHOLMSS1";
constexpr std::size_t kHead = 24;          // size in bytes
constexpr std::size_t kMaxItems = 10000;   // a sanity limit
constexpr std::size_t kMaxSteps = 100000;  // a sanity limit

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::kInvalidInput, "the session file " + what);
}

// Takes consecutive parts of a file's remaining bytes.
class Parts {
 public:
  explicit Parts(std::string_view bytes) : bytes_(bytes) {}
  std::string_view next(std::uint64_t size) {
    if (size > bytes_.size()) refuse("ends before what it says it holds");
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

std::string shape_file(const Item& item, Scratch& scratch) {
  if (!item.points && !item.original) return {};
  return scratch.written(".ply", [&](const std::filesystem::path& path) {
    if (item.points) {
      write_shape(*item.points, path);
    } else {
      write_shape(*item.original, path);
    }
  });
}

std::string model_file(const Item& item, Scratch& scratch) {
  if (item.atlas) return *item.atlas_file;
  if (!item.model) return {};
  return scratch.written(
      ".h5", [&](const std::filesystem::path& path) { write_model(item.model->expansion, path); });
}

Json about(const Item& item, std::size_t shape, std::size_t model) {
  return {{"name", item.name},         {"unit", item.unit},
          {"caps", item.caps},         {"shape_bytes", shape},
          {"model_bytes", model},      {"degree", item.look.degree},
          {"gains", item.look.gains},  {"limit", item.limit ? Json(*item.limit) : Json(nullptr)},
          {"file", item.file},         {"model_file", item.model_file},
          {"variable", item.variable}, {"model_variable", item.model_variable},
          {"placed", item.placed}};
}

// Joins both files of an item.
Item joined(std::string_view shape, std::string_view model, const Json& json, Scratch& scratch,
            const Context& context) {
  if (shape.empty()) return open_item("model.h5", model, scratch, context);
  Item item = open_item("shape.ply", shape, scratch, context);
  if (model.empty()) return item;
  const Item series = open_item("model.h5", model, scratch, context);
  if (!series.model || !item.original) refuse("has a model of what is no mesh");
  item.model = make_model(series.model->expansion, item.original, context);
  return with_look(item, look_in(json, *item.model), context);
}

Item read_item(const Json& json, Parts& parts, Scratch& scratch, const Context& context) {
  const auto size = [&](const char* field) {
    const auto found = json.find(field);
    if (found == json.end() || !found->is_number_unsigned()) refuse("says no size");
    return found->get<std::uint64_t>();
  };
  const std::string_view shape = parts.next(size("shape_bytes"));
  const std::string_view model = parts.next(size("model_bytes"));
  Item item = joined(shape, model, json, scratch, context);
  if (item.kind == Kind::kExpansion) item = with_look(item, look_in(json, *item.model), context);
  if (item.atlas && json.value("limit", Json(nullptr)).is_number_integer()) {
    item = with_limit(item, integer_of(json, "limit"), context);
  }
  item.name = plain_name(string_of(json, "name"));
  item.unit = plain_text(string_of(json, "unit"));
  if (!item.unit.empty()) check_unit(item.unit);
  if (!item.atlas) item.caps = static_cast<std::size_t>(std::max(0, integer_or(json, "caps", 0)));
  if (json.contains("placed")) item.placed = plain_text(string_of(json, "placed"));
  return item;
}

// Reads the item's names in the recipe: names that a step has made, or empty ones.
void read_names(Item& item, const Json& json, const Recipe& recipe) {
  const auto name = [&](const char* field, const auto& is_there) {
    std::string text = string_of(json, field);
    if (!text.empty() && !is_there(text)) refuse("has an item that no step has made");
    return text;
  };
  const auto is_file = [&](const std::string& text) { return recipe.files.contains(text); };
  const auto is_variable = [&](const std::string& text) { return recipe.has_variable(text); };
  item.file = name("file", is_file);
  item.model_file = name("model_file", is_file);
  item.variable = name("variable", is_variable);
  item.model_variable = name("model_variable", is_variable);
  const bool has_shape = item.original || item.points || item.atlas;
  const bool has_model = item.model || item.atlas;
  if ((has_shape && (item.file.empty() || item.variable.empty())) ||
      (has_model && (item.model_file.empty() || item.model_variable.empty()))) {
    refuse("has an item without a name in its steps");
  }
}

// Names an item of a file without steps, as if it had been saved and read again.
void name_anew(Item& item, Recipe& recipe) {
  const std::shared_ptr<const Model> model = item.model;
  if (item.original) item.model = nullptr;
  add_reading(recipe, item);
  if (!item.original || !model) return;
  item.model = model;
  item.model_file = recipe.file(stem_of(item.name), ".h5");
  item.model_variable = recipe.variable(stem_of(item.name) + "_model");
  recipe.add({{"op", "read"},
              {"made", json_of(Named{item.model_file, item.model_variable})},
              {"series", true}});
}

// Adds the file's steps; their lines are made again.
void join(Recipe& recipe, const Json& steps) {
  if (!steps.is_array() || steps.size() > kMaxSteps) refuse("has no list of steps");
  for (const Json& step : steps) recipe.add(step);
}

// Returns the JSON; `parts` keeps what follows.
Json checked_head(std::string_view bytes, Parts& parts) {
  std::uint64_t length = 0;
  std::uint32_t checksum = 0;
  const std::string_view head = parts.next(kHead);
  std::memcpy(&length, head.data() + kMagic.size(), sizeof length);
  std::memcpy(&checksum, head.data() + kMagic.size() + sizeof length, sizeof checksum);
  if (!kAnyChecksum && crc32(bytes.substr(kHead)) != checksum) {
    refuse("is damaged: its checksum is another");
  }
  return parse_object(parts.next(length));
}

}  // namespace

bool is_session_file(std::string_view bytes) { return bytes.starts_with(kMagic); }

std::string session_bytes(const Document& document, Scratch& scratch) {
  Json json = {{"items", Json::array()}, {"steps", document.recipe.steps}};
  std::string files;
  for (const ItemPtr& item : document.items) {
    const std::string shape = shape_file(*item, scratch), model = model_file(*item, scratch);
    json["items"].push_back(about(*item, shape.size(), model.size()));
    files += shape;
    files += model;
  }
  const std::string text = text_of(json), body = text + files;
  const std::uint64_t length = text.size();
  const std::uint32_t checksum = crc32(body), zero = 0;
  std::string all(kMagic);
  all.append(reinterpret_cast<const char*>(&length), sizeof length);
  all.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  all.append(reinterpret_cast<const char*>(&zero), sizeof zero);
  return all + body;
}

void open_session(std::string_view bytes, Scratch& scratch, Document& document, Shared& shared,
                  const Context& context) {
  Parts parts(bytes);
  try {
    const Json json = checked_head(bytes, parts);
    const auto items = json.find("items");
    if (items == json.end() || !items->is_array() || items->size() > kMaxItems) {
      refuse("has no list of items");
    }
    // Files of earlier versions have lines, which cannot be checked, and no steps.
    const auto steps = json.find("steps");
    const bool has_steps = steps != json.end();
    if (has_steps) join(document.recipe, *steps);
    for (const Json& one : *items) {
      if (!one.is_object()) refuse("has an item that is none");
      Item item = read_item(one, parts, scratch, context);
      if (has_steps) {
        read_names(item, one, document.recipe);
      } else {
        name_anew(item, document.recipe);
      }
      add(document, std::move(item), shared);
    }
    if (!parts.at_end()) refuse("has more bytes than it says");
  } catch (const Refusal& refusal) {
    refuse(std::string("says what cannot be: ") + refusal.what());
  }
}

}  // namespace rholm::studio
