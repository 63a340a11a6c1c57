// What the reports of several commands share: JSON of our types, tables of text. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/terminal/json.h"
#include "rholm/analyze.h"
#include "rholm/coefficients.h"
#include "rholm/mesh.h"
#include "rholm/star.h"
#include "rholm/topology.h"

namespace rholm::cli {

Json json_of(const Bounds& bounds);
Json json_of(const std::vector<Attribute>& attributes);
// Both with "kinds", what each figure of an error is worth: "exact" but for rounding, "measured"
// against the shape, or an "estimate" by a model of what is left.
Json json_of(const TruncationErrors& errors);
Json json_of(const FastReport& fast);
template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
inline Json json_of(const std::optional<TruncationErrors>& errors) {
  return errors ? json_of(*errors) : Json(nullptr);
}

// Writes a report as print_text() does (session.h).
void print_json(const Json& json);

// A line "  name            value\n" of a report in text.
std::string line(const std::string& name, const std::string& value);

// "yes", or "no, WHY".
std::string yes_or(bool yes, const std::string& otherwise);

// Seven significant digits.
std::string text_of(double value);
std::string text_of(const Vec3& v);                // "(x, y, z)"
std::string text_of(const GravityField& gravity);  // "gravity constant 4e14 m^3/s^2, ..."
std::string text_of(const std::vector<Attribute>& attributes);  // "red (uint8), ..."

// "1 vertex", "2 vertices"; `many` by default with an s.
std::string counted(std::size_t n, const std::string& one, const std::string& many = {});

// The figures of the star check.
std::string star_report_text(const StarReport& report, double diagonal);

}  // namespace rholm::cli
