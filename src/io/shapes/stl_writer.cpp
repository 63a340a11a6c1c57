// STL: the corners of every triangle with its normal, as floats or as text with all digits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "io/file/scalar_bytes.h"
#include "io/shapes/shape_writers.h"
#include "rholm/error.h"
#include "rholm/vec3.h"

namespace rholm {
namespace {

// Measures what coordinates lose if a format stores them in single precision.

// Takes the faces that are written, with their corners in double precision.
class SinglePrecisionLoss {
 public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c);

  // Returns the spacing of floats at the largest coordinate.
  double step() const;
  // Returns a warning for a file in this format, or none if faces keep their shape and steps are
  // below 1e-5 of the diagonal. `instead` names formats that hold the digits.
  std::optional<std::string> warning(const std::string& format, const std::string& instead) const;

 private:
  Vec3 min_ = {}, max_ = {};
  std::size_t faces_ = 0;
  std::size_t lost_ = 0;  // faces that lose their area or turn by more than 10 degrees
};

double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

Vec3 rounded(const Vec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

// Smallest cosine of the angle that a face may turn. A shape centred at the origin has larger turns
// only in faces that are as narrow as the rounding. Chosen: cosine of 10 degrees.
constexpr double kLeastCosine = 0.984808;

// A shape centred at the origin has steps of 6e-8 of its diagonal. Chosen: about a hundred times
// this deserves a warning.
constexpr double kMostStep = 1e-5;

void SinglePrecisionLoss::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (faces_++ == 0) min_ = max_ = a;
  for (const Vec3* p : {&a, &b, &c}) {
    min_ = {std::min(min_.x, p->x), std::min(min_.y, p->y), std::min(min_.z, p->z)};
    max_ = {std::max(max_.x, p->x), std::max(max_.y, p->y), std::max(max_.z, p->z)};
  }
  const Vec3 u = normalized(b - a), v = normalized(c - a);
  const Vec3 before = normalized(cross(u, v));
  if (before == Vec3{}) return;  // the face has no area to lose
  const Vec3 ra = rounded(a);
  const Vec3 after = normalized(cross(normalized(rounded(b) - ra), normalized(rounded(c) - ra)));
  lost_ += !(dot(before, after) >= kLeastCosine);
}

double SinglePrecisionLoss::step() const {
  double largest = 0;
  for (const double c : {min_.x, min_.y, min_.z, max_.x, max_.y, max_.z}) {
    largest = std::max(largest, std::abs(c));
  }
  const auto value = static_cast<float>(largest);
  return static_cast<double>(std::nextafter(value, std::numeric_limits<float>::infinity())) -
         static_cast<double>(value);
}

std::optional<std::string> SinglePrecisionLoss::warning(const std::string& format,
                                                        const std::string& instead) const {
  if (faces_ == 0) return std::nullopt;
  const double spacing = step();
  const bool coarse = spacing > kMostStep * norm(max_ - min_);
  if (lost_ == 0 && !coarse) return std::nullopt;
  std::string text = fmt::format("{} has single precision, in steps of {:.3g} at these coordinates",
                                 format, spacing);
  if (lost_ > 0) {
    text += fmt::format(": {} of {} faces lose their area or turn by more than 10 degrees", lost_,
                        faces_);
  }
  return text + fmt::format("; {}", instead) + (coarse ? ", or move the shape to the origin" : "");
}

// Floats have full precision within 1.2e-38 ... 3.4e38. Small coordinates beside larger ones may
// round to 0, but not all coordinates of a shape.
void check_range(const ShapeView& shape, const std::string& name) {
  double largest = 0;
  shape.points.visit([&](std::size_t, const Vec3& p) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  });
  const bool small = largest > 0 && largest < std::numeric_limits<float>::min();
  if (largest < kInfiniteAsFloat && !small) return;
  char digits[kMaxNumberLength];
  throw Error(ErrorCode::kInvalidInput,
              name + ": the largest coordinate, " +
                  std::string(digits, format_number(digits, largest)) +
                  ", does not fit the floats of binary STL (1.2e-38 ... 3.4e38): scale the "
                  "shape, or write STL as text, PLY, OBJ or OFF");
}

// Returns the normal before the corners are rounded; zero if the triangle has no area.
Vec3 facet_normal(const ShapeView& shape, const Triangle& t) {
  const Vec3 a = shape.points[t[0]];
  return normalized(cross(shape.points[t[1]] - a, shape.points[t[2]] - a));
}

void put_floats(const Vec3& v, char* to) {
  store_little_endian(to, static_cast<float>(v.x));
  store_little_endian(to + 4, static_cast<float>(v.y));
  store_little_endian(to + 8, static_cast<float>(v.z));
}

std::vector<std::string> put_binary(const ShapeView& shape, OutputBuffer& out) {
  SinglePrecisionLoss loss;
  // 80 bytes that do not begin with "solid", which some readers take for text.
  std::string header = "binary STL";
  header.resize(80, ' ');
  out.text(header);
  char* count = out.room(4);
  store_little_endian(count, static_cast<std::uint32_t>(shape.faces.size()));
  out.advance(count + 4);
  shape.faces.visit([&](std::size_t, const Triangle& t) {
    constexpr std::size_t kFacet = 50;
    char* to = out.room(kFacet);
    put_floats(facet_normal(shape, t), to);
    const std::array<Vec3, 3> corners = {shape.points[t[0]], shape.points[t[1]],
                                         shape.points[t[2]]};
    for (std::size_t k = 0; k < 3; ++k) put_floats(corners[k], to + 12 + 12 * k);
    loss.add(corners[0], corners[1], corners[2]);
    to[48] = to[49] = 0;
    out.advance(to + kFacet);
    out.rows(1);
  });
  const auto warning = loss.warning("binary STL", "STL as text, PLY, OBJ and OFF keep all digits");
  return warning ? std::vector<std::string>{*warning} : std::vector<std::string>{};
}

void put_float_text(const Vec3& v, OutputBuffer& out) {
  out.number(static_cast<float>(v.x), ' ');
  out.number(static_cast<float>(v.y), ' ');
  out.number(static_cast<float>(v.z), '\n');
}

void put_ascii(const ShapeView& shape, OutputBuffer& out) {
  out.text("solid rholm\n");
  shape.faces.visit([&](std::size_t, const Triangle& t) {
    out.text("facet normal ");
    put_float_text(facet_normal(shape, t), out);
    out.text("outer loop\n");
    for (const std::uint32_t corner : t) {
      out.text("vertex ");
      put_vector(shape.points[corner], '\n', out);
    }
    out.text("endloop\nendfacet\n");
    out.rows(1);
  });
  out.text("endsolid rholm\n");
}

}  // namespace

std::vector<std::string> format_stl(const ShapeView& shape, const ShapeWriting& how,
                                    OutputBuffer& out) {
  if (!how.ascii) check_range(shape, how.name);
  if (shape.faces.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::kUnsupported, how.name + ": STL holds at most 4294967295 facets, not " +
                                             std::to_string(shape.faces.size()));
  }
  if (!how.ascii) return put_binary(shape, out);
  put_ascii(shape, out);
  return {};
}

}  // namespace rholm
