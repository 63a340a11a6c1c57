// Gravity fields in ICGEM files: what their coefficients are relative to. Layer: io.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "rholm/coefficients.h"

namespace rholm {

// What the coefficients of a gravity field are relative to.
struct GravityField {
  double constant = 0;  // G M in m^3/s^2; finite and above 0
  double radius = 0;    // of the reference sphere in m; finite and above 0
};

// Of a file whose header says that it is of a gravity field, and both numbers; none for all others.
// The first is for bytes in memory. Throws Io if the file cannot be read.
std::optional<GravityField> gravity_field_of(std::span<const char> bytes);
std::optional<GravityField> read_gravity_field(const std::filesystem::path& path);

// Writes an ICGEM file of a gravity field as other programs read it, whatever the extension of the
// path; "-" is standard output. read_coefficients() reads it back. Throws InvalidInput for numbers
// that are not above 0, and for an expansion whose function is not kOther; Io.
void write_gravity_field(const Expansion& expansion, const GravityField& gravity,
                         const std::filesystem::path& path, const Convention& convention = {});

}  // namespace rholm
