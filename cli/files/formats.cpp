#include "cli/files/formats.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/plain_text.h"

namespace rholm::cli {
namespace {

bool holds(const ShapeFormatInfo& format, Holding holding) {
  switch (holding) {
    case Holding::kFaces:
      return format.faces;
    case Holding::kPoints:
      return format.points;
    case Holding::kAnything:
      break;
  }
  return true;
}

std::string dotted(const FileFormat& format) { return "." + format.extensions.front().name; }

std::string joined(const std::vector<std::string>& words, const std::string& last) {
  return last.empty() ? fmt::format("{}", fmt::join(words, ", ")) : listed(words, last);
}

// Returns `word` of each format that can be written and satisfies `wanted`.
template <typename Info, typename Wanted, typename Word>
std::vector<std::string> words_of(const std::vector<Info>& formats, const Wanted& wanted,
                                  const Word& word) {
  std::vector<std::string> words;
  for (const Info& format : formats) {
    if (format.file.written && wanted(format)) words.push_back(word(format.file));
  }
  return words;
}

constexpr auto kName = [](const FileFormat& format) { return format.name; };
constexpr auto kAll = [](const auto&) { return true; };

}  // namespace

std::vector<std::string> shape_format_names(Holding holding) {
  return words_of(
      shape_formats(), [&](const ShapeFormatInfo& format) { return holds(format, holding); },
      kName);
}

std::vector<std::string> coefficients_format_names() {
  return words_of(coefficients_formats(), kAll, kName);
}

std::string shape_extensions(Holding holding, const std::string& last) {
  return joined(words_of(
                    shape_formats(),
                    [&](const ShapeFormatInfo& format) { return holds(format, holding); }, dotted),
                last);
}

std::string coefficients_extensions() {
  return joined(words_of(coefficients_formats(), kAll, dotted), "");
}

std::string meaningful_extensions(const std::string& last) {
  return joined(words_of(
                    coefficients_formats(),
                    [](const CoefficientsFormatInfo& format) { return format.meaning; }, dotted),
                last);
}

std::string extensions_by_holding() {
  std::string text = joined(
      words_of(
          shape_formats(),
          [](const ShapeFormatInfo& format) { return format.faces && format.points; }, dotted),
      "");
  const auto add = [&](const char* what, Holding holding) {
    const std::vector<std::string> words = words_of(
        shape_formats(),
        [&](const ShapeFormatInfo& format) {
          return holds(format, holding) && format.faces != format.points;
        },
        dotted);
    if (!words.empty()) text += fmt::format(", {} as {}", what, listed(words, "or"));
  };
  add("meshes", Holding::kFaces);
  add("points", Holding::kPoints);
  return text;
}

std::string ascii_help(Holding holding) {
  const std::vector<std::string> titles = words_of(
      shape_formats(),
      [&](const ShapeFormatInfo& format) {
        return holds(format, holding) && format.file.text && format.file.binary;
      },
      [](const FileFormat& format) { return format.title; });
  return listed(titles, "and") + " as text";
}

std::string coefficients_list() {
  const auto words = words_of(coefficients_formats(), kAll, [](const FileFormat& format) {
    std::vector<std::string> extensions;
    extensions.reserve(format.extensions.size());
    for (const FileExtension& extension : format.extensions) {
      extensions.push_back("." + extension.name);
    }
    return fmt::format("{} ({})", format.title, fmt::join(extensions, ", "));
  });
  return joined(words, "");
}

bool holds_meaning(const std::string& name) {
  return std::ranges::any_of(coefficients_formats(), [&](const CoefficientsFormatInfo& format) {
    return format.file.name == name && format.meaning;
  });
}

std::string extension_of_format(const std::string& name) {
  for (const ShapeFormatInfo& format : shape_formats()) {
    if (format.file.name == name) return format.file.extensions.front().name;
  }
  for (const CoefficientsFormatInfo& format : coefficients_formats()) {
    if (format.file.name == name) return format.file.extensions.front().name;
  }
  return name;
}

}  // namespace rholm::cli
