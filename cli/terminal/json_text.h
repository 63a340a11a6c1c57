// Common parts of reports: JSON of library types, tables of text. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/terminal/json.h"
#include "rholm/coefficients.h"
#include "rholm/mesh.h"
#include "rholm/star.h"
#include "rholm/topology.h"
#include "rholm/transform.h"

namespace rholm::cli {

Json json_of(const Bounds& bounds);
Json json_of(const std::vector<Attribute>& attributes);
// Returns the fields; null for those without a meaning, as the volume of an open mesh.
Json json_of(const Inspection& inspection);
// Return JSON with "kinds", the quality of each error: "exact" up to rounding, "measured" against
// the shape, or an "estimate" from a model of the truncation error.
Json json_of(const TruncationErrors& errors);
Json json_of(const FastReport& fast);
template <typename T>
Json json_of(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
inline Json json_of(const std::optional<TruncationErrors>& errors) {
  return errors ? json_of(*errors) : Json(nullptr);
}

// Writes a report by print_text() (session.h).
void print_json(const Json& json);

// Returns a line " name value\n" of a text report.
std::string line(const std::string& name, const std::string& value);

// Returns "yes", or "no, WHY".
std::string yes_or(bool yes, const std::string& otherwise);

// Returns seven significant digits.
std::string text_of(double value);
std::string text_of(const Vec3& v);                // "(x, y, z)"
std::string text_of(const GravityField& gravity);  // "gravity constant 4e14 m^3/s^2, ..."
std::string text_of(const std::vector<Attribute>& attributes);  // "red (uint8), ..."

// Returns "1 vertex", "2 vertices"; by default `many` is `one` with an s.
std::string counted(std::size_t n, const std::string& one, const std::string& many = {});

// Returns the numbers of the star check.
std::string star_report_text(const StarReport& report, double diagonal);

}  // namespace rholm::cli
