#include "reconstruct/points/point_rows.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>

#include "base/refuse.h"
#include "io/file/scalar_bytes.h"

namespace rholm {
namespace {

constexpr bool kSwap = std::endian::native == std::endian::big;

std::size_t bytes_of_type(ScalarType type) {
  return with_scalar_type(type, [](auto t) { return sizeof(typename decltype(t)::type); });
}

// By the bits: GCC 12.2 takes a double for one that was rounded to float and back, where it makes
// vectors of them. Numbers below the normal ones are not looked at: they are taken for wider.
bool is_single(double value) {
  constexpr std::uint64_t kSmallest = 1023 - 126, kExponents = 254, kInfinite = 2047;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t exponent = bits >> 52 & kInfinite;
  const bool in_range =
      exponent - kSmallest < kExponents || exponent == kInfinite || bits << 1 == 0;
  return in_range && (bits & 0x1fffffff) == 0;
}

template <class T>
bool has_value(double value) {
  if constexpr (std::is_same_v<T, double>) {
    return true;
  } else if constexpr (std::is_same_v<T, float>) {
    return is_single(value);
  } else {
    return value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max() &&
           static_cast<double>(static_cast<T>(value)) == value;
  }
}

bool all_single(std::span<const Vec3> vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const Vec3& v) {
    return is_single(v.x) && is_single(v.y) && is_single(v.z);
  });
}

ScalarType kept_type(const Attribute& attribute) {
  const bool fits = with_scalar_type(attribute.type, [&](auto t) {
    using T = typename decltype(t)::type;
    return std::all_of(attribute.values.begin(), attribute.values.end(), has_value<T>);
  });
  return fits ? attribute.type : ScalarType::kFloat64;
}

template <class T>
std::byte* put_value(std::byte* to, T value) {
  store_little_endian(reinterpret_cast<char*>(to), value);
  return to + sizeof(T);
}
// 0 for -0: which of the two comes first would be a matter of the file.
std::byte* put_vector(std::byte* to, const Vec3& given, bool single) {
  const Vec3 v = given + Vec3{};
  if (single) {
    to = put_value(to, static_cast<float>(v.x));
    to = put_value(to, static_cast<float>(v.y));
    return put_value(to, static_cast<float>(v.z));
  }
  to = put_value(to, v.x);
  to = put_value(to, v.y);
  return put_value(to, v.z);
}

template <class T>
T value_at(const std::byte* from) {
  return load<T, kSwap>(reinterpret_cast<const char*>(from));
}
Vec3 vector_at(const std::byte* from, bool single) {
  if (single) return {value_at<float>(from), value_at<float>(from + 4), value_at<float>(from + 8)};
  return {value_at<double>(from), value_at<double>(from + 8), value_at<double>(from + 16)};
}

constexpr std::size_t vector_bytes(bool single) { return single ? 12 : 24; }

}  // namespace

std::size_t PointLayout::row_bytes() const {
  std::size_t bytes = vector_bytes(single_points) + (normals ? vector_bytes(single_normals) : 0);
  for (const ColumnLayout& column : columns) bytes += bytes_of_type(column.kept);
  return bytes;
}

PointLayout layout_of(const PointCloud& cloud) {
  PointLayout layout{.single_points = all_single(cloud.points),
                     .single_normals = all_single(cloud.normals),
                     .normals = !cloud.normals.empty(),
                     .columns = {}};
  for (const Attribute& a : cloud.attributes)
    layout.columns.push_back({a.name, a.type, kept_type(a)});
  return layout;
}

void widen(PointLayout& layout, const PointLayout& other) {
  bool same = layout.columns.size() == other.columns.size();
  for (std::size_t k = 0; same && k < layout.columns.size(); ++k) {
    ColumnLayout& own = layout.columns[k];
    const ColumnLayout& wider = other.columns[k];
    same = own.name == wider.name && own.type == wider.type;
    if (wider.kept != own.type) own.kept = wider.kept;
  }
  if (!same) refuse("the points have not the same attributes from the first to the last");
  layout.single_points = layout.single_points && other.single_points;
  layout.single_normals = layout.single_normals && other.single_normals;
  layout.normals = layout.normals || other.normals;
}

void put_row(const PointLayout& layout, const PointCloud& cloud, std::size_t i, std::byte* to) {
  to = put_vector(to, cloud.points[i], layout.single_points);
  if (layout.normals) {
    const bool is_there = !cloud.normals.empty() && is_finite(cloud.normals[i]);
    to = put_vector(to, is_there ? cloud.normals[i] : Vec3{}, layout.single_normals);
  }
  for (std::size_t k = 0; k < layout.columns.size(); ++k) {
    const double value = cloud.attributes[k].values[i];
    to = with_scalar_type(layout.columns[k].kept, [&](auto t) {
      return put_value(to, static_cast<typename decltype(t)::type>(value));
    });
  }
}

PointCloud empty_cloud(const PointLayout& layout) {
  PointCloud cloud;
  for (const ColumnLayout& c : layout.columns) cloud.attributes.push_back({c.name, c.type, {}});
  return cloud;
}

void reserve_rows(const PointLayout& layout, std::size_t n, PointCloud& cloud) {
  cloud.points.reserve(n);
  if (layout.normals) cloud.normals.reserve(n);
  for (Attribute& a : cloud.attributes) a.values.reserve(n);
}

bool is_within(const Bounds& box, const Vec3& p) {
  return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x &&
         p.y <= box.max.y && p.z <= box.max.z;
}

void take_rows(const PointLayout& layout, std::span<const std::byte> rows, PointCloud& cloud,
               const Bounds* box, std::vector<std::uint32_t>* taken) {
  const std::size_t bytes = layout.row_bytes(), n = rows.size() / bytes;
  if (n * bytes != rows.size() || cloud.attributes.size() != layout.columns.size()) {
    refuse("a piece of the points has not the layout that the run has; begin it anew");
  }
  for (const std::byte* from = rows.data(); from != rows.data() + rows.size(); from += bytes) {
    const Vec3 p = vector_at(from, layout.single_points);
    if (box != nullptr && !is_within(*box, p)) continue;
    if (taken != nullptr) {
      taken->push_back(
          static_cast<std::uint32_t>(static_cast<std::size_t>(from - rows.data()) / bytes));
    }
    cloud.points.push_back(p);
    const std::byte* at = from + vector_bytes(layout.single_points);
    if (layout.normals) {
      cloud.normals.push_back(vector_at(at, layout.single_normals));
      at += vector_bytes(layout.single_normals);
    }
    for (std::size_t k = 0; k < layout.columns.size(); ++k) {
      at += with_scalar_type(layout.columns[k].kept, [&](auto t) {
        using T = typename decltype(t)::type;
        cloud.attributes[k].values.push_back(static_cast<double>(value_at<T>(at)));
        return sizeof(T);
      });
    }
  }
}

// Flags (1 byte), then of each column its types (2), the length of its name (4), the name.
std::vector<std::byte> layout_bytes(const PointLayout& layout) {
  std::vector<std::byte> bytes;
  const int flags =
      (layout.single_points ? 1 : 0) | (layout.single_normals ? 2 : 0) | (layout.normals ? 4 : 0);
  bytes.push_back(static_cast<std::byte>(flags));
  for (const ColumnLayout& column : layout.columns) {
    bytes.push_back(static_cast<std::byte>(column.type));
    bytes.push_back(static_cast<std::byte>(column.kept));
    std::byte size[4];
    put_value(size, static_cast<std::uint32_t>(column.name.size()));
    bytes.insert(bytes.end(), size, size + 4);
    const auto name = std::as_bytes(std::span(column.name));
    bytes.insert(bytes.end(), name.begin(), name.end());
  }
  return bytes;
}

PointLayout parse_layout(std::span<const std::byte> bytes) {
  const auto fail = [] { refuse("a piece has no layout of points; begin the run anew"); };
  if (bytes.empty() || bytes[0] > std::byte{7}) fail();
  const auto flags = static_cast<int>(bytes[0]);
  PointLayout layout{.single_points = (flags & 1) != 0,
                     .single_normals = (flags & 2) != 0,
                     .normals = (flags & 4) != 0,
                     .columns = {}};
  constexpr auto kLast = static_cast<std::byte>(ScalarType::kFloat64);
  for (bytes = bytes.subspan(1); !bytes.empty();) {
    if (bytes.size() < 6 || bytes[0] > kLast || bytes[1] > kLast) fail();
    const std::size_t size = value_at<std::uint32_t>(bytes.data() + 2);
    if (size > bytes.size() - 6) fail();
    layout.columns.push_back({std::string(reinterpret_cast<const char*>(bytes.data()) + 6, size),
                              static_cast<ScalarType>(bytes[0]),
                              static_cast<ScalarType>(bytes[1])});
    bytes = bytes.subspan(6 + size);
  }
  return layout;
}

}  // namespace rholm
