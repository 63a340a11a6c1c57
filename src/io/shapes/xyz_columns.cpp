#include "io/shapes/xyz_columns.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "io/shapes/shape_source.h"

namespace rholm {
namespace {

using Names3 = std::array<const char*, 3>;
using Places3 = std::array<std::size_t, 3>;

std::string lower(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

// The columns of these three names in either case, if all are there.
std::optional<Places3> find_three(const std::vector<std::string>& names, const Names3& wanted) {
  Places3 places;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& n) { return lower(n) == wanted[k]; });
    if (found == names.end()) return std::nullopt;
    places[k] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

std::optional<Places3> find_position(const std::vector<std::string>& names) {
  if (const auto xyz = find_three(names, {"x", "y", "z"})) return xyz;
  return find_three(names, {"points:0", "points:1", "points:2"});
}

std::optional<Places3> find_normal(const std::vector<std::string>& names) {
  for (const Names3& wanted : {Names3{"nx", "ny", "nz"}, Names3{"normal_x", "normal_y", "normal_z"},
                               Names3{"normals:0", "normals:1", "normals:2"}}) {
    if (const auto places = find_three(names, wanted)) return places;
  }
  return std::nullopt;
}

std::vector<Vec3> join(const std::vector<std::vector<double>>& columns, const Places3& places) {
  std::vector<Vec3> vectors(columns[places[0]].size());
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = {columns[places[0]][i], columns[places[1]][i], columns[places[2]][i]};
  }
  return vectors;
}

bool are_unit_normals(const std::vector<Vec3>& vectors) {
  UnitVectors units;
  for (const Vec3& v : vectors) units.add(v);
  return units.all_are();
}

bool are_bytes(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double v) { return is_value_of(ScalarType::kUint8, v); });
}

class ColumnTaker {
 public:
  ColumnTaker(PointCloud& cloud, std::vector<std::vector<double>>& columns)
      : cloud_(cloud), columns_(columns) {}

  void take_normals(const Places3& places) {
    cloud_.normals = join(columns_, places);
    taken_.insert(places.begin(), places.end());
  }
  void take_colors(const Places3& places) {
    constexpr Names3 kColors = {"red", "green", "blue"};
    const auto bytes = [&](std::size_t place) { return are_bytes(columns_[place]); };
    const bool all = std::all_of(places.begin(), places.end(), bytes);
    for (std::size_t k = 0; k < 3; ++k) {
      take(places[k], kColors[k], all ? ScalarType::kUint8 : ScalarType::kFloat64);
    }
  }
  void take(std::size_t place, std::string name, ScalarType type) {
    if (!taken_.insert(place).second) return;
    cloud_.attributes.push_back(
        {.name = std::move(name), .type = type, .values = std::move(columns_[place])});
  }

  bool is_taken(std::size_t place) const { return taken_.contains(place); }

 private:
  PointCloud& cloud_;
  std::vector<std::vector<double>>& columns_;
  std::set<std::size_t> taken_;
};

void take_named(ColumnTaker& taker, const ColumnRoles& roles) {
  if (const auto normal = find_normal(roles.names)) taker.take_normals(*normal);
  for (const Names3& wanted : {Names3{"red", "green", "blue"}, Names3{"r", "g", "b"}}) {
    if (const auto color = find_three(roles.names, wanted)) {
      taker.take_colors(*color);
      break;
    }
  }
  for (const std::size_t k : roles.others) {
    const std::string& name = roles.names[k];
    taker.take(k, name.empty() ? "column_" + std::to_string(k + 1) : name, ScalarType::kFloat64);
  }
}

}  // namespace

void UnitVectors::add(const Vec3& v) {
  if (v == Vec3{}) return;
  (std::abs(norm(v) - 1) <= 0.01 ? some_ : other_) = true;
}

bool has_position(const std::vector<std::string>& names) {
  return find_position(names).has_value();
}

ColumnRoles column_roles(const std::vector<std::string>& names, std::size_t n) {
  ColumnRoles roles{.others = {}, .names = names};
  if (!names.empty()) roles.position = *find_position(names);
  for (std::size_t k = 0; k < n; ++k) {
    const bool position =
        std::find(roles.position.begin(), roles.position.end(), k) != roles.position.end();
    if (!position) roles.others.push_back(k);
  }
  return roles;
}

void take_columns(PointCloud& cloud, const ColumnRoles& roles,
                  std::vector<std::vector<double>>& columns, bool first_are_normals) {
  ColumnTaker taker(cloud, columns);
  if (!roles.names.empty()) return take_named(taker, roles);
  const std::size_t n = roles.others.size();
  const Places3 first = {3, 4, 5};
  if (n >= 3 && (first_are_normals || are_unit_normals(join(columns, first)))) {
    taker.take_normals(first);
  } else if (n == 3 && are_bytes(columns[3]) && are_bytes(columns[4]) && are_bytes(columns[5])) {
    taker.take_colors(first);
  }
  std::size_t number = 0;
  for (const std::size_t k : roles.others) {
    if (taker.is_taken(k)) continue;
    taker.take(k, "scalar_" + std::to_string(++number), ScalarType::kFloat64);
  }
}

}  // namespace rholm
