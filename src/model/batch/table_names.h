// Names in files of results: docs/batch.md. Layer: model, private.
#pragma once

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

}  // namespace rholm
