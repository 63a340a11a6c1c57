// Items as files: the library writes them, as it does for the program.
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "rholm/coefficients_io.h"
#include "rholm/file.h"
#include "rholm/model.h"
#include "rholm/render.h"
#include "rholm/report.h"
#include "rholm/shape_io.h"
#include "studio/answers.h"

namespace rholm::studio {
namespace {

constexpr const char* kBytes = "application/octet-stream";

bool is_one_of(const std::string& format, const std::vector<std::string>& list) {
  return std::find(list.begin(), list.end(), format) != list.end();
}

// "shtools" is written as .sh, "icgem" as .gfc; the others are called as they end.
std::string ending_of(const std::string& format) {
  if (format == "shtools") return ".sh";
  if (format == "icgem") return ".gfc";
  return "." + format;
}

std::string shape_bytes(const Item& item, const std::string& format, Scratch& scratch,
                        const Context& context) {
  const ShapeWriteOptions options = {.format = parse_shape_format(format)};
  return scratch.written("." + format, [&](const std::filesystem::path& path) {
    if (item.points) {
      write_shape(*item.points, path, options, context);
    } else {
      write_shape(*item.shown, path, options, context);
    }
  });
}

std::string coefficients_bytes(const Item& item, const std::string& format, Scratch& scratch) {
  if (item.atlas) return *item.atlas_file;
  return scratch.written(ending_of(format), [&](const std::filesystem::path& path) {
    const Expansion expansion = expansion_of(*item.model, item.look);
    if (format == "h5") return write_model(expansion, path);
    const CoefficientsFormat written =
        format == "txt" ? CoefficientsFormat::kShtools : parse_coefficients_format(format);
    write_coefficients(expansion, path, {.format = written});
  });
}

// "1024x768"; within what render() takes is for it to say.
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

// Letters that every system has in names; no path.
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
  Response response = {.type = kBytes, .download = download_name(item, ending_of(format))};
  if (is_one_of(format, {"ply", "obj", "off"}) || format == (item.points ? "xyz" : "stl")) {
    response.body = shape_bytes(item, format, scratch, context);
  } else if (format == "png") {
    response.type = "image/png";
    response.body = picture_bytes(item, size, context);
  } else if (format == "html") {
    response.type = "text/html";
    response.body = report_bytes(item, recipe, context);
  } else if ((item.atlas && format == "h5") ||
             (item.model && is_one_of(format, {"h5", "json", "npy", "shtools", "icgem", "txt"}))) {
    response.body = coefficients_bytes(item, format, scratch);
  } else {
    throw bad_request(
        fmt::format("{} ({}) is not saved as '{}'", item.name, to_string(item.kind), format));
  }
  return response;
}

}  // namespace rholm::studio
