// Tables as the content of files: their names, values as text, and bytes. Layer: model, private.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rholm/batch.h"

namespace rholm {

inline constexpr const char* kCoefficientsColumn = "coefficients";

// HDF5: the dataset with the names of all columns in order, and attributes of the root.
inline constexpr const char* kColumnNames = "columns";
inline constexpr const char* kBatchFormat = "rholm-batch";
inline constexpr int kBatchMajor = 1;
inline constexpr int kBatchMinor = 0;
inline constexpr const char* kBatchRows = "rows";
inline constexpr const char* kBatchLeading = "leading";
inline constexpr const char* kBatchAbout = "about";  // lines "name=value"

// Attribute of a dataset whose values have a kind that HDF5 has no type for.
inline constexpr const char* kBooleanMark = "boolean";

bool has_value(const Cell& cell);
// Returns a list without NaN at its end.
std::span<const double> trimmed(const std::vector<double>& list);

// Returns the shortest digits that read back as the same number; empty for a missing number.
std::string number_text(double value);
// Returns true, false, numbers, texts unchanged, and lists with spaces between numbers.
std::string cell_text(const Cell& cell);

std::string table_csv(const BatchTable& table, bool with_coefficients, bool raw_cells = false);
// Returns a table whose values are all texts. Throws InvalidInput; `name` is the file.
BatchTable parse_table_csv(std::span<const char> text, const std::string& name);

// Writes the layout of docs/batch.md. Replaces the file when the new one is complete.
void write_table_hdf5(const BatchTable& table, const std::filesystem::path& path);
BatchTable parse_table_hdf5(std::span<const char> bytes, const std::string& name);

}  // namespace rholm
