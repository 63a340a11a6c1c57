#include "studio/open.h"

#include <functional>
#include <optional>

#include "rholm/coefficients_io.h"
#include "rholm/error.h"
#include "rholm/formats.h"
#include "rholm/model.h"
#include "rholm/shape_io.h"
#include "studio/names.h"

namespace rholm::studio {
namespace {

constexpr std::size_t kHead = 4096;  // bytes; enough for every signature

// Calls `read` and rethrows its errors with the user's file name instead of the path.
void read_as(const std::string& name, const std::filesystem::path& path,
             const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    std::string message = error.what();
    const std::size_t at = message.find(path.string());
    if (at == std::string::npos) throw;
    throw Error(error.code(), message.replace(at, path.string().size(), name));
  }
}

// The library reads a model file only by its path.
Item open_model(std::string_view bytes, const std::string& name, Scratch& scratch,
                const Context& context) {
  std::optional<Item> item;
  scratch.read(bytes, ".h5", [&](const std::filesystem::path& path) {
    read_as(name, path, [&] {
      item = is_atlas_file(path) ? item_of(read_atlas(path), context)
                                 : item_of(read_model(path), context);
    });
  });
  if (item->atlas) item->atlas_file = std::make_shared<const std::string>(bytes);
  return *std::move(item);
}

TableColumns printable(TableColumns told) {
  told.note = plain_text(told.note);
  for (TableColumn& column : told.columns) {
    column.name = plain_text(column.name);
    column.taken_for = plain_text(column.taken_for);
  }
  return told;
}

std::vector<std::string> printable(std::vector<std::string> warnings) {
  for (std::string& warning : warnings) warning = plain_text(warning);
  return warnings;
}

Item open_shape(std::string_view bytes, const std::string& name, const Context& context,
                const std::string& columns = {}) {
  ShapeFile file = parse_shape(bytes, name, {.columns = columns}, context);
  auto* mesh = std::get_if<Mesh>(&file.shape);
  Item item = mesh != nullptr ? item_of(std::move(*mesh), context)
                              : item_of(std::get<PointCloud>(std::move(file.shape)));
  item.warnings = printable(std::move(file.warnings));
  if (!file.table.columns.empty() && item.points) {
    item.table =
        std::make_shared<const Table>(Table{.bytes = std::make_shared<const std::string>(bytes),
                                            .told = printable(std::move(file.table)),
                                            .name = name,
                                            .file = {},
                                            .variable = {}});
  }
  return item;
}

Item open_coefficients(std::string_view bytes, const std::string& name, const Context& context) {
  return item_of(parse_coefficients(bytes, name).expansion, context);
}

Item open_text(std::string_view bytes, const std::string& name, const Context& context) {
  const std::optional<bool> shape = is_shape_file(bytes.substr(0, kHead), name);
  if (shape) {
    return *shape ? open_shape(bytes, name, context) : open_coefficients(bytes, name, context);
  }
  std::string reason;
  try {
    return open_shape(bytes, name, context);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled || error.code() == ErrorCode::kOutOfMemory) throw;
    reason = error.what();
  }
  try {
    return open_coefficients(bytes, name, context);
  } catch (const Error&) {
    throw Error(ErrorCode::kUnsupported, reason);
  }
}

}  // namespace

Item open_item(const std::string& name, std::string_view bytes, Scratch& scratch,
               const Context& context, const std::string& columns) {
  const std::string plain = plain_name(name);
  Item item;
  if (!columns.empty()) {
    item = open_shape(bytes, plain, context, columns);
  } else if (bytes.starts_with("\x89HDF\r\n\x1a\n")) {
    item = open_model(bytes, plain, scratch, context);
  } else {
    item = open_text(bytes, plain, context);
  }
  item.name = plain;
  item.unit = plain_text(item.unit);
  return item;
}

Item open_table(const Table& table, const std::string& columns, const Context& context) {
  Item item = open_shape(*table.bytes, table.name, context, columns);
  auto told = std::make_shared<Table>(*item.table);
  told->bytes = table.bytes;  // one copy
  told->file = table.file;
  told->variable = table.variable;
  item.table = std::move(told);
  return item;
}

void record_columns(Recipe& recipe, Item& item, const std::string& columns) {
  const Named from = {item.table->file, item.table->variable};
  const Named made = {recipe.file(stem_of(from.file) + "-columns", ".ply"),
                      recipe.variable(stem_of(from.file) + "_columns")};
  recipe.add(
      {{"op", "columns"}, {"from", json_of(from)}, {"made", json_of(made)}, {"columns", columns}});
  item.file = made.file;
  item.variable = made.variable;
}

}  // namespace rholm::studio
