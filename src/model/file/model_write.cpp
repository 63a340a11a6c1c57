// Writes the model file. Layout: docs/model-file.md.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/crc32.h"
#include "io/coefficients/expansion_check.h"
#include "io/coefficients/known_numbers.h"
#include "io/file/atomic_file.h"
#include "io/hdf5/hdf5_writer.h"
#include "reconstruct/file/model_file.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/version.h"

namespace rholm {
namespace {

using hdf5::Writer;

// Checksum of the coefficients as stored, the unit and the method, for which HDF5 itself has no
// checksum.
std::uint32_t model_crc32(const Expansion& expansion) {
  static_assert(std::endian::native == std::endian::little, "the file is little endian");
  const std::span<const double> values = expansion.coefficients.values();
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return crc32(expansion.method, crc32(expansion.unit, crc32(bytes)));
}

void write_errors(Writer& writer, Writer::Object group, const TruncationErrors& errors) {
  const auto write = [&](const char* name, const std::optional<double>& value) {
    if (value) writer.write_attribute(group, name, *value);
  };
  write(layout::kErrorRms, errors.rms);
  writer.write_attribute(group, layout::kErrorRmsIsExact, errors.rms_is_exact ? 1 : 0);
  writer.write_attribute(group, layout::kDistancesAreClosest, errors.distances_are_closest ? 1 : 0);
  write(layout::kPredictedMax, errors.predicted_max);
  write(layout::kPredictedMaxDistance, errors.predicted_max_distance);
  write(layout::kMeasuredMax, errors.measured_max);
  write(layout::kMaxBound, errors.max_bound);
  write(layout::kMeasuredMaxDistance, errors.measured_max_distance);
  write(layout::kDistanceRms, errors.distance_rms);
  writer.write_attribute(group, layout::kErrorPoints, static_cast<double>(errors.points));
  writer.write_attribute(group, layout::kDiagonal, errors.diagonal);
}

void write_expansion(Writer& writer, Writer::Object group, const Expansion& expansion) {
  const std::uint64_t side = static_cast<std::uint64_t>(expansion.coefficients.degree()) + 1;
  const std::array<std::uint64_t, 3> extents = {2, side, side};
  writer.write_dataset(group, layout::kCoefficients, extents,
                       expansion.coefficients.values().data());
  writer.write_attribute(group, layout::kDegree, expansion.coefficients.degree());
  writer.write_attribute(group, layout::kNormalization, to_string(Normalization::kOrthonormal));
  writer.write_attribute(group, layout::kCsphase, 1);
  writer.write_attribute(group, layout::kFunction, to_string(expansion.function));
  writer.write_attribute(group, layout::kCenter, expansion.center);
  writer.write_attribute(group, layout::kUnit, expansion.unit);
  writer.write_attribute(group, layout::kMethod, expansion.method);
  writer.write_attribute(group, layout::kCrc32, model_crc32(expansion));
  const KnownNumbers numbers = known_numbers(expansion);
  for (const KnownNumber& number : kKnownNumbers) {
    const std::optional<double>& value = numbers.*number.value;
    if (value) writer.write_attribute(group, number.name, *value);
  }
  if (expansion.signed_sum) writer.write_attribute(group, layout::kSignedSum, 1);
  if (expansion.errors) write_errors(writer, group, *expansion.errors);
}

}  // namespace

void write_model(const Expansion& expansion, const std::filesystem::path& path) {
  const std::string name = path.string();
  check_expansion(expansion, name);
  AtomicFile output(path);
  if (output.temporary_path().empty()) {
    throw Error(ErrorCode::kUnsupported, name +
                                             ": a model file needs a file that can be "
                                             "rewound, not a pipe: write .json instead");
  }
  Writer writer(name, output.temporary_path().string());
  writer.write_attribute(Writer::kRoot, layout::kFormat, layout::kFormatName);
  writer.write_attribute(Writer::kRoot, layout::kVersionMajor, layout::kMajor);
  writer.write_attribute(Writer::kRoot, layout::kVersionMinor, layout::kMinor);
  writer.write_attribute(Writer::kRoot, layout::kProgram, std::string("rholm ") + kVersion);
  write_expansion(writer, writer.create_group(Writer::kRoot, layout::kExpansion), expansion);
  writer.close();
  output.commit();
}

}  // namespace rholm
