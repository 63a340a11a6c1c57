// Reads the model file. Layout: docs/model-file.md.
#include "model/file/model_read.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/crc32.h"
#include "base/plain_text.h"
#include "io/coefficients/expansion_check.h"
#include "io/coefficients/known_numbers.h"
#include "io/coefficients/text_table.h"
#include "io/file/bytes.h"
#include "io/hdf5/hdf5_values.h"
#include "reconstruct/file/model_file.h"
#include "rholm/error.h"
#include "rholm/model.h"

namespace rholm {
namespace {

class ModelReader {
 public:
  ModelReader(std::string_view bytes, const std::string& name) : file_(hdf5::open(bytes, name)) {}

  Expansion read() const {
    const hdf5::Object root = hdf5::root_group(file_);
    check_model_version(file_, root);
    if (!hdf5::has_member(file_, root, layout::kExpansion) &&
        hdf5::has_member(file_, root, layout::kAtlas)) {
      refuse(
          "the model is an atlas of caps, not one expansion: make a mesh of it with 'rholm "
          "synthesize'",
          ErrorCode::kUnsupported);
    }
    return read_expansion(hdf5::open_member(file_, root, layout::kExpansion));
  }

 private:
  [[noreturn]] void refuse(const std::string& what,
                           ErrorCode code = ErrorCode::kInvalidInput) const {
    throw Error(code, file_.name + ": " + what);
  }

  hdf5::Array attribute(const hdf5::Object& object, const char* name) const {
    const auto found = hdf5::find_attribute(file_, object, name);
    if (!found) refuse(fmt::format("'{}' has no attribute '{}'", object.path, name));
    return *found;
  }
  std::string text(const hdf5::Object& object, const char* name) const {
    return hdf5::to_text(file_, attribute(object, name));
  }
  std::string optional_text(const hdf5::Object& object, const char* name) const {
    const auto found = hdf5::find_attribute(file_, object, name);
    return found ? hdf5::to_text(file_, *found) : std::string();
  }
  std::int64_t integer(const hdf5::Object& object, const char* name) const {
    return hdf5::to_integer(file_, attribute(object, name));
  }
  std::vector<double> numbers(const hdf5::Object& object, const char* name,
                              std::size_t count) const {
    std::vector<double> values = hdf5::to_doubles(file_, attribute(object, name));
    if (values.size() != count) {
      refuse(fmt::format("the attribute '{}' has {} numbers instead of {}", name, values.size(),
                         count));
    }
    return values;
  }
  std::optional<double> optional_number(const hdf5::Object& object, const char* name) const {
    if (!hdf5::find_attribute(file_, object, name)) return std::nullopt;
    return numbers(object, name, 1)[0];
  }

  // Files of other programs need not have the checksum.
  void check_crc32(const hdf5::Object& group, const hdf5::Array& coefficients,
                   const Expansion& expansion) const {
    const auto stored = hdf5::find_attribute(file_, group, layout::kCrc32);
    if (!stored) return;
    const std::uint32_t found =
        crc32(expansion.method, crc32(expansion.unit, crc32(coefficients.data)));
    if (hdf5::to_integer(file_, *stored) != found && !kAnyChecksum) {
      refuse("its checksum is wrong: the file is damaged, or edited (then delete the attribute " +
             group.path + "@" + layout::kCrc32 + ")");
    }
  }

  Coefficients to_coefficients(const hdf5::Array& array) const {
    const auto& extents = array.extents;
    if (extents.size() != 3 || extents[0] != 2 || extents[1] != extents[2] || extents[1] < 1 ||
        extents[1] > kMaxDegree + std::size_t{1}) {
      refuse(fmt::format("the shape of '{}' is ({}): it must be (2, L+1, L+1), L from 0 to {}",
                         array.path, fmt::join(extents, ", "), kMaxDegree));
    }
    const std::vector<double> values = hdf5::to_doubles(file_, array);
    Coefficients result(static_cast<int>(extents[1]) - 1);
    std::copy(values.begin(), values.end(), result.values().begin());
    return result;
  }

  // Returns a length, which is not negative.
  std::optional<double> optional_length(const hdf5::Object& object, const char* name) const {
    const std::optional<double> value = optional_number(object, name);
    if (value && !(*value >= 0 && std::isfinite(*value))) {
      refuse(fmt::format("the attribute '{}' is {}: it must be a length", name, *value));
    }
    return value;
  }

  std::optional<TruncationErrors> read_errors(const hdf5::Object& group) const {
    const std::optional<double> points = optional_length(group, layout::kErrorPoints);
    if (!points) return std::nullopt;
    TruncationErrors errors;
    errors.rms = optional_length(group, layout::kErrorRms);
    errors.distances_are_closest =
        hdf5::find_attribute(file_, group, layout::kDistancesAreClosest) &&
        integer(group, layout::kDistancesAreClosest) == 1;
    errors.rms_is_exact = hdf5::find_attribute(file_, group, layout::kErrorRmsIsExact) &&
                          integer(group, layout::kErrorRmsIsExact) == 1;
    errors.predicted_max = optional_length(group, layout::kPredictedMax);
    errors.predicted_max_distance = optional_length(group, layout::kPredictedMaxDistance);
    errors.measured_max = optional_length(group, layout::kMeasuredMax);
    errors.max_bound = optional_length(group, layout::kMaxBound);
    errors.measured_max_distance = optional_length(group, layout::kMeasuredMaxDistance);
    errors.distance_rms = optional_length(group, layout::kDistanceRms);
    errors.points = static_cast<std::size_t>(std::min(*points, 1e18));
    errors.diagonal = optional_length(group, layout::kDiagonal).value_or(0);
    return errors;
  }

  Expansion read_expansion(const hdf5::Object& group) const {
    const std::string normalization = text(group, layout::kNormalization);
    const std::int64_t csphase = integer(group, layout::kCsphase);
    if (normalization != to_string(Normalization::kOrthonormal) || csphase != 1) {
      refuse(fmt::format("normalization {} and csphase {}: a model has orthonormal and 1",
                         in_quotes(normalization), csphase),
             ErrorCode::kUnsupported);
    }
    Expansion expansion;
    const hdf5::Array array =
        hdf5::read_dataset(file_, hdf5::open_member(file_, group, layout::kCoefficients));
    expansion.coefficients = to_coefficients(array);
    const std::int64_t degree = integer(group, layout::kDegree);
    if (degree != expansion.coefficients.degree()) {
      refuse(fmt::format("it says degree {} and has coefficients up to {}", degree,
                         expansion.coefficients.degree()));
    }
    expansion.function = parse_name<RadialFunction>(text(group, layout::kFunction));
    const std::vector<double> center = numbers(group, layout::kCenter, 3);
    expansion.center = {center[0], center[1], center[2]};
    expansion.unit = optional_text(group, layout::kUnit);
    expansion.method = optional_text(group, layout::kMethod);
    KnownNumbers known;
    for (const KnownNumber& number : kKnownNumbers) {
      known.*number.value = optional_number(group, number.name);
    }
    set_known_numbers(known, file_.name, expansion);
    expansion.signed_sum = hdf5::find_attribute(file_, group, layout::kSignedSum) &&
                           integer(group, layout::kSignedSum) == 1;
    expansion.errors = read_errors(group);
    check_crc32(group, array, expansion);
    check_expansion(expansion, file_.name);
    return expansion;
  }

  hdf5::File file_;
};

std::string_view text_of(std::span<const char> bytes) { return {bytes.data(), bytes.size()}; }

}  // namespace

Expansion parse_model(std::span<const char> bytes, const std::string& name) {
  check_model_signature(bytes, name);
  return ModelReader(text_of(bytes), name).read();
}

Expansion read_model(const std::filesystem::path& path) {
  const Bytes bytes = read_bytes(path);
  return parse_model(bytes.view(), path == "-" ? "standard input" : path.string());
}

CoefficientsFile read_any_coefficients(const std::filesystem::path& path,
                                       const CoefficientsReadOptions& options,
                                       const Context& context) {
  const Bytes bytes = read_bytes(path, context);
  const std::string name = path == "-" ? "standard input" : path.string();
  if (!looks_like_model(bytes.view())) return parse_coefficients(bytes.view(), name, options);
  CoefficientsFile file;
  file.expansion = parse_model(bytes.view(), name);
  file.convention = {Normalization::kOrthonormal, 1};
  return file;
}

}  // namespace rholm
