// The beginning that all model files have in common.
#include "reconstruct/file/model_file.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <string>

#include "rholm/atlas_model.h"
#include "rholm/error.h"

namespace rholm {

bool looks_like_model(std::span<const char> bytes) {
  return hdf5::has_signature({bytes.data(), bytes.size()});
}

void check_model_signature(std::span<const char> bytes, const std::string& name) {
  if (looks_like_model(bytes)) return;
  throw Error(ErrorCode::kInvalidInput, name + ": it is not an HDF5 file, so not a model");
}

void check_model_version(const hdf5::File& file, const hdf5::Object& root) {
  const auto format = hdf5::find_attribute(file, root, layout::kFormat);
  if (!format || hdf5::to_text(file, *format) != layout::kFormatName) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("{}: an HDF5 file without the attribute {} = {}: it is not a model",
                            file.name, layout::kFormat, layout::kFormatName));
  }
  const auto major = hdf5::find_attribute(file, root, layout::kVersionMajor);
  if (!major) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{}: '/' has no attribute '{}'", file.name, layout::kVersionMajor));
  }
  const std::int64_t found = hdf5::to_integer(file, *major);
  if (found == layout::kMajor) return;
  throw Error(ErrorCode::kUnsupported,
              fmt::format("{}: the model has version {}, this program reads {}: use a newer rholm",
                          file.name, found, layout::kMajor));
}

bool is_model_file(const std::filesystem::path& path) {
  if (path == "-") return false;
  std::array<char, 8> first = {};
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorCode::kIo, "cannot read " + path.string());
  file.read(first.data(), first.size());
  return looks_like_model({first.data(), static_cast<std::size_t>(file.gcount())});
}

}  // namespace rholm
