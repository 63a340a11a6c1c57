// An atlas as stored in a file, with its measured errors (method 7.8). Layer: reconstruct.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "rholm/atlas.h"
#include "rholm/fields.h"
#include "rholm/surface_rules.h"

namespace rholm {

// Measured errors of a model. Lengths in the shape's unit.
struct AtlasErrors {
  double rms_from = 0, max_from = 0;  // distances from the shape to the model's surface
  double rms_to = 0, max_to = 0;      // distances from that surface to the shape; 0 for points
  // Return the larger of both directions.
  double rms() const { return rms_from > rms_to ? rms_from : rms_to; }
  double max() const { return max_from > max_to ? max_from : max_to; }
  // Returns true if both directions were measured.
  bool two_sided() const { return max_to > 0; }
};

// Lists the fields of AtlasErrors.
template <typename Visitor>
void visit_fields(FieldsOf<AtlasErrors>, const Visitor& field) {
  using E = AtlasErrors;
  field(&E::rms_from, {.name = "rms_from",
                       .help = "root mean square distance from the shape to the model's surface",
                       .unit = FieldUnit::kLength});
  field(&E::max_from,
        {.name = "max_from", .help = "largest of these distances", .unit = FieldUnit::kLength});
  field(&E::rms_to,
        {.name = "rms_to",
         .help =
             "root mean square distance from the model's surface to the shape; 0 if that is points",
         .unit = FieldUnit::kLength});
  field(&E::max_to, {.name = "max_to",
                     .help = "largest of these distances; 0 if the shape is points",
                     .unit = FieldUnit::kLength});
}

// An atlas, and the metadata of its file.
struct AtlasModel {
  Atlas atlas;                             // the caps
  double step = 0;                         // step of the grid at which its surface was measured
  double tolerance = 0;                    // wanted tolerance; 0: none
  std::optional<AtlasErrors> errors = {};  // measured on the extracted surface
  std::size_t input_numbers = 0;           // coordinates of the shape: 3 per vertex; 0: not known
  std::string unit, method;                // unit of lengths, and method; may be empty
  // For a reconstruction: rules that extract the same surface from the caps, to the bit. Empty:
  // holes are closed, and parts below 1/100 of the largest area are dropped.
  std::optional<SurfaceRules> rules = {};
};

// Write and read the model file of an atlas: docs/model-file.md. Throw as for other models.
void write_atlas(const AtlasModel& model, const std::filesystem::path& path);
AtlasModel read_atlas(const std::filesystem::path& path);
bool is_atlas_file(const std::filesystem::path& path);  // true for a model file that holds an atlas
bool is_model_file(const std::filesystem::path& path);  // true for any model, by its first bytes

}  // namespace rholm
