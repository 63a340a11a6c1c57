#include "cli/terminal/json_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/plain_text.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/session.h"

namespace rholm::cli {
namespace {

const char* name_of(ScalarType type) {
  constexpr const char* kNames[] = {"int8",  "uint8",  "int16",   "uint16",
                                    "int32", "uint32", "float32", "float64"};
  return kNames[static_cast<int>(type)];
}

// Returns the JSON without control sequences of terminals. Outside of strings, where escapes are
// not allowed, JSON has no control characters except line ends.
std::string shown_json(std::string_view json) {
  std::string shown;
  while (!json.empty()) {
    const Utf8Character character = first_character(json);
    if (character.code == '\n' || is_shown(character.code)) {
      shown += character.bytes;
    } else {
      shown += fmt::format("\\u{:04x}", static_cast<unsigned>(character.code));
    }
    json.remove_prefix(character.bytes.size());
  }
  return shown;
}

std::string percent(double share) { return fmt::format("{:.4g} %", 100 * share); }

}  // namespace

Json json_of(const Bounds& bounds) {
  return {
      {"min", json_of(bounds.min)}, {"max", json_of(bounds.max)}, {"diagonal", bounds.diagonal()}};
}

Json json_of(const Inspection& inspection) {
  Json json = json_of_fields(inspection);
  json["bounds"] = json_of(inspection.bounds);
  const bool solid = inspection.closed && inspection.oriented;
  if (!inspection.closed || !inspection.manifold) json["genus"] = nullptr;
  if (!solid) json["volume"] = json["volume_centroid"] = nullptr;
  return json;
}

Json json_of(const std::vector<Attribute>& attributes) {
  Json list = Json::array();
  for (const Attribute& attribute : attributes) {
    list.push_back({{"name", attribute.name}, {"type", name_of(attribute.type)}});
  }
  return list;
}

Json json_of(const TruncationErrors& errors) {
  Json json = json_of_fields(errors);
  json.erase("diagonal");
  json["kinds"] = {{"rms", errors.rms_is_exact ? "exact" : "measured"},
                   {"predicted_max", "estimate"},
                   {"predicted_max_distance", "estimate"},
                   {"measured_max", "measured"},
                   {"max_bound", "bound"},
                   {"measured_max_distance", "measured"},
                   {"distance_rms", "measured"}};
  return json;
}

Json json_of(const FastReport& fast) {
  const bool measured = fast.measured_share > 0;
  const char* kind = measured ? "measured" : "estimate";
  return {
      {"precision", fast.single ? "single" : "double"},
      {"window_width", fast.width},
      {"oversampling", fast.oversampling},
      {"lumped_faces", fast.lumped_faces},
      {"vertices", fast.vertices},
      {"nodes", fast.nodes},
      {"passes", fast.passes},
      {"precision_reached", fast.reached},
      {"error", fast.error},
      {"error_of_top_quarter", fast.band_error},
      {"measured_share", fast.measured_share},
      {"error_uncertainty", measured ? Json(fast.error_uncertainty) : Json(nullptr)},
      {"kinds",
       {{"error", kind}, {"error_of_top_quarter", "estimate"}, {"error_uncertainty", "estimate"}}}};
}

void print_json(const Json& json) {
  // Names of files may hold any bytes; bytes that are not UTF-8 are replaced.
  print_exactly(shown_json(json.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n");
}

std::string line(const std::string& name, const std::string& value) {
  return fmt::format("  {:<18} {}\n", escaped_line(name), escaped_line(value));
}

std::string yes_or(bool yes, const std::string& otherwise) {
  return yes ? "yes" : "no, " + otherwise;
}

std::string text_of(double value) { return fmt::format("{:.7g}", value + 0.0); }

std::string text_of(const Vec3& v) {
  return fmt::format("({}, {}, {})", text_of(v.x), text_of(v.y), text_of(v.z));
}

std::string text_of(const GravityField& gravity) {
  return fmt::format("gravity constant {} m^3/s^2, reference radius {} m", gravity.gravity_constant,
                     gravity.reference_radius);
}

std::string text_of(const std::vector<Attribute>& attributes) {
  std::vector<std::string> names;
  names.reserve(attributes.size());
  for (const Attribute& attribute : attributes) {
    names.push_back(fmt::format("{} ({})", attribute.name, name_of(attribute.type)));
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", n, n == 1 ? one : many.empty() ? one + "s" : many);
}

std::string star_report_text(const StarReport& report, double diagonal) {
  std::string text = line("centre", text_of(report.center));
  if (report.center_fell_back) {
    text += line("", "(no point sees the whole surface: the best of two guesses)");
  }
  text += line("star-shaped",
               yes_or(report.star_shaped,
                      counted(report.bad_faces, "face turns its back", "faces turn their backs") +
                          " to the centre"));
  text += line("min d", fmt::format("{} ({:.3g} of the diagonal)", text_of(report.min_d),
                                    diagonal > 0 ? report.min_d / diagonal : 0.0));
  text += line("min cos gamma", text_of(report.min_cos_gamma));
  if (report.rays > 0) {
    text += line("directions",
                 fmt::format("{} tried: {} meet the surface once, {} more than "
                             "once, {} never",
                             report.rays, percent(report.once_share),
                             percent(report.multiple_share), percent(report.missed_share)));
  }
  return text;
}

}  // namespace rholm::cli
