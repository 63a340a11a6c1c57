// Tables as the content of files. Layer: model, private.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "rholm/batch.h"

namespace rholm {

std::string table_csv(const BatchTable& table, bool with_coefficients, bool raw_cells = false);
// All values as texts. Throws InvalidInput; `name` is the file.
BatchTable parse_table_csv(std::span<const char> text, const std::string& name);

// Layout: docs/batch.md. The file is replaced when complete.
void write_table_hdf5(const BatchTable& table, const std::filesystem::path& path);
BatchTable parse_table_hdf5(std::span<const char> bytes, const std::string& name);

}  // namespace rholm
