// Tables as the content of files: their names, values as text, and bytes. Layer: model, private.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rholm/batch.h"

namespace rholm {

inline constexpr const char* kCoefficientsColumn = "coefficients";

// HDF5: the dataset of the names of all columns in their order, and attributes of the root.
inline constexpr const char* kColumnNames = "columns";
inline constexpr const char* kBatchFormat = "rholm-batch";
inline constexpr int kBatchMajor = 1;
inline constexpr int kBatchMinor = 0;
inline constexpr const char* kBatchRows = "rows";
inline constexpr const char* kBatchLeading = "leading";
inline constexpr const char* kBatchAbout = "about";  // lines "name=value"

// Of a dataset: what its values are, where the type of HDF5 does not say it.
inline constexpr const char* kBooleanMark = "boolean";

bool has_value(const Cell& cell);
// A list without the numbers at its end that are none.
std::span<const double> trimmed(const std::vector<double>& list);

// Shortest digits that read back as the same number; empty for what is not there.
std::string number_text(double value);
// true, false, numbers, texts as they are, lists with spaces between.
std::string cell_text(const Cell& cell);

std::string table_csv(const BatchTable& table, bool with_coefficients, bool raw_cells = false);
// All values as texts. Throws InvalidInput; `name` is the file.
BatchTable parse_table_csv(std::span<const char> text, const std::string& name);

// Layout: docs/batch.md. The file is replaced when complete.
void write_table_hdf5(const BatchTable& table, const std::filesystem::path& path);
BatchTable parse_table_hdf5(std::span<const char> bytes, const std::string& name);

}  // namespace rholm
