// Saves items as files, written by the library as for the program.
#include <charconv>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rholm/coefficients_io.h"
#include "rholm/file.h"
#include "rholm/model.h"
#include "rholm/render.h"
#include "rholm/report.h"
#include "rholm/shape_io.h"
#include "studio/answers.h"
#include "studio/items/saved_formats.h"

namespace rholm::studio {
namespace {

constexpr const char* kBytes = "application/octet-stream";

// Format selected by its name or by a file extension.
struct Wanted {
  SavedFormat format;
  std::string ending;  // includes the dot
};
std::optional<Wanted> wanted_format(const Item& item, const std::string& wanted) {
  for (const SavedFormat& format : saved_formats(item)) {
    const std::vector<FileExtension>& extensions = format.file->extensions;
    if (wanted == format.file->name) return Wanted{format, "." + extensions.front().name};
    for (const FileExtension& extension : extensions) {
      if (wanted == extension.name && !extension.read_only) return Wanted{format, "." + wanted};
    }
  }
  return std::nullopt;
}

std::string shape_bytes(const Item& item, const Wanted& wanted, Scratch& scratch,
                        const Context& context) {
  const ShapeWriteOptions options = {.format = parse_shape_format(wanted.format.file->name)};
  return scratch.written(wanted.ending, [&](const std::filesystem::path& path) {
    if (item.points) {
      write_shape(*item.points, path, options, context);
    } else {
      write_shape(*item.shown, path, options, context);
    }
  });
}

std::string coefficients_bytes(const Item& item, const Wanted& wanted, Scratch& scratch) {
  if (item.atlas) return *item.atlas_file;
  return scratch.written(wanted.ending, [&](const std::filesystem::path& path) {
    const Expansion expansion = expansion_of(*item.model, item.look);
    const std::string& format = wanted.format.file->name;
    if (is_model_name(path)) return write_model(expansion, path);
    write_coefficients(expansion, path, {.format = parse_coefficients_format(format)});
  });
}

// Parses "1024x768"; render() checks the range.
void set_size(const std::string& size, RenderOptions& options) {
  if (size.empty()) return;
  const char* end = size.data() + size.size();
  const auto [x, no_width] = std::from_chars(size.data(), end, options.width);
  if (no_width == std::errc() && x != end && *x == 'x') {
    const auto [rest, no_height] = std::from_chars(x + 1, end, options.height);
    if (no_height == std::errc() && rest == end) return;
  }
  throw bad_request(fmt::format("the size must be WIDTHxHEIGHT, as 1024x768, not '{}'", size));
}

std::string picture_bytes(const Item& item, const std::string& size, const Context& context) {
  RenderOptions options;
  set_size(size, options);
  const Panel panel = {.mesh = item.shown.get(), .points = item.points.get()};
  const std::vector<char> png = encode_png(render(std::span(&panel, 1), options, context));
  return {png.begin(), png.end()};
}

std::string report_bytes(const Item& item, const Recipe& recipe, const Context& context) {
  if (!item.model && !item.atlas) {
    throw Refusal(422, "wrong_kind",
                  item.name + " has neither an expansion nor caps to report on; analyze it first");
  }
  ReportOptions options = {.title = item.name};
  for (const std::string& line : recipe.shell) options.commands.push_back({"Step", line});
  if (item.atlas) return report_html(*item.atlas, nullptr, options, context);
  if (item.original) options.shape_name = item.name;
  return report_html(expansion_of(*item.model, item.look), item.original.get(), options, context);
}

// Returns a name of characters that every system allows, without a path.
std::string download_name(const Item& item, const std::string& ending) {
  std::string name = stem_of(item.name) + ending;
  for (char& c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '.' || c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return name;
}

}  // namespace

Response save_answer(const Item& item, const Recipe& recipe, const std::string& format,
                     const std::string& size, Scratch& scratch, const Context& context) {
  const std::optional<Wanted> wanted = wanted_format(item, format);
  const std::string ending = wanted ? wanted->ending : "." + format;
  Response response = {.type = kBytes, .download = download_name(item, ending)};
  if (wanted) {
    response.body = wanted->format.is_shape ? shape_bytes(item, *wanted, scratch, context)
                                            : coefficients_bytes(item, *wanted, scratch);
  } else if (format == "png") {
    response.type = "image/png";
    response.body = picture_bytes(item, size, context);
  } else if (format == "html") {
    response.type = "text/html";
    response.body = report_bytes(item, recipe, context);
  } else {
    std::vector<std::string> names;
    for (const SavedFormat& known : saved_formats(item)) names.push_back(known.file->name);
    throw bad_request(fmt::format("{} ({}) is not saved as '{}': {}, png or html", item.name,
                                  to_string(item.kind), format, fmt::join(names, ", ")));
  }
  return response;
}

}  // namespace rholm::studio
