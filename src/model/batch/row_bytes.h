// A row of results as bytes, little endian. Layer: model, private.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rholm/batch.h"

namespace rholm {

std::string row_bytes(const BatchRow& cells);
// Returns none if the bytes are no row: too short, too long, or with an unknown kind of value.
std::optional<BatchRow> parse_row(std::string_view bytes);

void put_u32(std::string& bytes, std::uint32_t value);
void put_u64(std::string& bytes, std::uint64_t value);
// Return the number at the beginning, which must exist.
std::uint32_t get_u32(std::string_view bytes);
std::uint64_t get_u64(std::string_view bytes);

}  // namespace rholm
