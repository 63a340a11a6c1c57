// STL: the corners of every triangle, with its normal: as floats, or as text with all digits.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/file/scalar_bytes.h"
#include "io/shapes/shape_writers.h"
#include "io/shapes/single_precision.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Floats have their full precision within 1.2e-38 ... 3.4e38; small coordinates beside larger ones
// may round to 0, those of a whole shape may not.
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

// Of the triangle before its corners are rounded; zero if it has no area.
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
  // 80 bytes that do not begin with "solid", as some readers take that for text.
  std::string header = "binary STL";
  header.resize(80, ' ');
  out.text(header);
  char* count = out.room(4);
  store_little_endian(count, static_cast<std::uint32_t>(shape.triangles.size()));
  out.advance(count + 4);
  shape.triangles.visit([&](std::size_t, const Triangle& t) {
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
  shape.triangles.visit([&](std::size_t, const Triangle& t) {
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
  if (shape.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::kUnsupported, how.name + ": STL holds at most 4294967295 facets, not " +
                                             std::to_string(shape.triangles.size()));
  }
  if (!how.ascii) return put_binary(shape, out);
  put_ascii(shape, out);
  return {};
}

}  // namespace rholm
