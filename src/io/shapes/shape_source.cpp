#include "io/shapes/shape_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/plain_text.h"
#include "io/file/scalar_bytes.h"
#include "rholm/error.h"

namespace rholm {
namespace {

std::span<const char> without_byte_order_mark(std::span<const char> bytes) {
  const std::string_view text(bytes.data(), bytes.size());
  return text.starts_with("\xEF\xBB\xBF") ? bytes.subspan(3) : bytes;
}

template <class Integer>
bool is_integer_of(double value) {
  return value >= static_cast<double>(std::numeric_limits<Integer>::min()) &&
         value <= static_cast<double>(std::numeric_limits<Integer>::max()) &&
         value == std::trunc(value);
}

// A double may be beyond the range of a float, where a cast is undefined.
bool is_float(double value) {
  if (!std::isfinite(value)) return true;
  return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()) &&
         static_cast<double>(static_cast<float>(value)) == value;
}

// Returns the nearest float, or the value itself if that float is infinite. The volatile is needed:
// GCC 12 removes double -> float -> double from pairs of these statements when it vectorises them
// (-ftree-slp-vectorize).
double nearest_float(double value) {
  if (!(std::abs(value) < kInfiniteAsFloat)) return value;
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

}  // namespace

ShapeSource::ShapeSource(std::span<const char> file_bytes, std::string file_name,
                         const ShapeReadOptions& options, const Context& context,
                         double progress_from)
    : bytes(without_byte_order_mark(file_bytes)),
      name(std::move(file_name)),
      attributes(options.attributes),
      columns(options.columns),
      context_(context),
      progress_from_(progress_from),
      next_report_(bytes.data()) {}

void ShapeSource::report(const char* at) const {
  const std::ptrdiff_t done = at - bytes.data();
  const double part = static_cast<double>(done) / static_cast<double>(bytes.size());
  report_progress(context_, "read", progress_from_ + part * (1 - progress_from_));
  // A percent, but at least 64 kB: a callback may cost a microsecond, as much as parsing 1 kB.
  const std::size_t step = std::max<std::size_t>(bytes.size() / 100, std::size_t{1} << 16);
  const std::size_t left = bytes.size() - static_cast<std::size_t>(done);
  next_report_ = at + std::min(step, left);
}

void ShapeSource::fail(const std::string& what) const {
  throw Error(ErrorCode::kInvalidInput, name + ": " + what);
}

void check_finite(const ShapeSource& source, std::span<const Vec3> vectors,
                  std::size_t first_number, const char* owner, const char* what) {
  // The first loop has no branches, so that it is vectorised.
  constexpr double kMax = std::numeric_limits<double>::max();
  int bad = 0;
  for (const Vec3& v : vectors) {
    bad |= static_cast<int>(!(std::abs(v.x) <= kMax)) | static_cast<int>(!(std::abs(v.y) <= kMax)) |
           static_cast<int>(!(std::abs(v.z) <= kMax));
  }
  if (bad == 0) return;
  const auto place = std::find_if_not(vectors.begin(), vectors.end(), is_finite);
  source.fail(std::string(owner) + " " +
              std::to_string(first_number + static_cast<std::size_t>(place - vectors.begin())) +
              " has a " + what + " that is not a finite number");
}

std::vector<Attribute> vector_attributes(std::span<const Vec3> vectors,
                                         const std::array<const char*, 3>& names) {
  if (vectors.empty()) return {};
  constexpr std::array<double Vec3::*, 3> kComponents = {&Vec3::x, &Vec3::y, &Vec3::z};
  std::vector<Attribute> attributes;
  for (std::size_t k = 0; k < 3; ++k) {
    Attribute a{.name = names[k], .type = ScalarType::kFloat64, .values = {}};
    a.values.reserve(vectors.size());
    for (const Vec3& v : vectors) a.values.push_back(v.*kComponents[k]);
    attributes.push_back(std::move(a));
  }
  return attributes;
}

bool is_value_of(ScalarType type, double value) {
  switch (type) {
    case ScalarType::kInt8:
      return is_integer_of<std::int8_t>(value);
    case ScalarType::kUint8:
      return is_integer_of<std::uint8_t>(value);
    case ScalarType::kInt16:
      return is_integer_of<std::int16_t>(value);
    case ScalarType::kUint16:
      return is_integer_of<std::uint16_t>(value);
    case ScalarType::kInt32:
      return is_integer_of<std::int32_t>(value);
    case ScalarType::kUint32:
      return is_integer_of<std::uint32_t>(value);
    case ScalarType::kFloat32:
      return is_float(value);
    case ScalarType::kFloat64:
      return true;
  }
  return false;
}

void settle_attribute_types(std::vector<Attribute>& attributes,
                            std::vector<std::string>& warnings) {
  for (Attribute& attribute : attributes) {
    if (attribute.type == ScalarType::kFloat32) {
      for (double& value : attribute.values) value = nearest_float(value);
    }
    const auto fits = [&](double value) { return is_value_of(attribute.type, value); };
    if (!std::all_of(attribute.values.begin(), attribute.values.end(), fits)) {
      attribute.type = ScalarType::kFloat64;
      warnings.push_back("attribute " + in_quotes(attribute.name) +
                         " has values its type cannot hold: kept as double");
    }
  }
}

std::string not_finite_warning(const std::string& attribute, std::size_t n) {
  return "attribute " + in_quotes(attribute) + " has " + counted(n, "value", "values") +
         " that are not finite numbers";
}

std::string counted(std::size_t n, const char* singular, const char* plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

}  // namespace rholm
