#include "io/shapes/xyz_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "base/plain_text.h"
#include "io/file/number_text.h"
#include "io/shapes/shape_source.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using Role = ColumnRole;

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::kInvalidInput, what); }

std::string short_number(double value) {
  char text[kMaxNumberLength];
  const double rounded = std::round(value * 1000) / 1000;
  return {text, format_number(text, rounded)};
}

// ---- What a user says ----

std::vector<std::string> split_columns(const std::string& columns) {
  std::vector<std::string> words(1);
  for (const char c : columns) {
    if (c == ',') {
      words.emplace_back();
    } else if (!is_blank(c)) {
      words.back() += c;
    }
  }
  return words;
}

Role asked_role(const std::string& word, bool has_green) {
  const std::string name = lower_case(word);
  if (name == "r") return has_green ? Role::kRed : Role::kRadius;
  for (int k = 0; k <= static_cast<int>(Role::kSkipped); ++k) {
    const auto role = static_cast<Role>(k);
    if (role != Role::kScalar && name == to_string(role)) return role;
  }
  if (name == "red") return Role::kRed;
  if (name == "green") return Role::kGreen;
  if (name == "blue") return Role::kBlue;
  if (name == "alpha") return Role::kAlpha;
  if (name == "latitude") return Role::kLatitude;
  if (name == "longitude") return Role::kLongitude;
  return Role::kScalar;
}

struct Asked {
  std::vector<Role> roles;
  std::vector<std::string> names;
};

Asked parse_columns(const std::string& columns) {
  Asked asked{.roles = {}, .names = split_columns(columns)};
  const auto has_word = [&](const char* a, const char* b) {
    return std::any_of(asked.names.begin(), asked.names.end(), [&](const std::string& word) {
      return lower_case(word) == a || lower_case(word) == b;
    });
  };
  const bool has_green = has_word("g", "green");
  std::set<std::string> seen;
  for (const std::string& word : asked.names) {
    const Role role = asked_role(word, has_green);
    const std::string name = role == Role::kScalar ? word : to_string(role);
    if (word.empty()) refuse("columns '" + columns + "': a column has no name; - passes over it");
    if (role != Role::kSkipped && !seen.insert(name).second) {
      refuse("columns " + in_quotes(columns) + ": " + in_quotes(name) + " stands there twice");
    }
    asked.roles.push_back(role);
  }
  const auto count = [&](std::initializer_list<const char*> names) {
    return std::count_if(names.begin(), names.end(),
                         [&](const char* n) { return seen.contains(n); });
  };
  const auto position = count({"x", "y", "z"}), degrees = count({"lat", "lon", "radius"});
  if (position % 3 != 0 || degrees % 3 != 0 || position + degrees != 3) {
    refuse("columns " + in_quotes(columns) + ": x, y, z or lat, lon, radius are needed, once each");
  }
  if (count({"nx", "ny", "nz"}) % 3 != 0)
    refuse("columns " + in_quotes(columns) + ": of nx, ny, nz some are missing");
  if (count({"r", "g", "b"}) % 3 != 0)
    refuse("columns " + in_quotes(columns) + ": of r, g, b some are missing");
  return asked;
}

// ---- What values look like ----

using Columns = std::vector<std::vector<double>>;

struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  bool whole = true;  // all are whole numbers
  std::size_t n = 0;  // number of values

  void add(const std::vector<double>& values) {
    for (const double v : values) {
      if (std::isnan(v)) continue;
      min = std::min(min, v);
      max = std::max(max, v);
      whole = whole && v == std::floor(v);
      ++n;
    }
  }
};

Range range_of(const Columns& columns, std::initializer_list<std::size_t> places) {
  Range range;
  for (const std::size_t place : places) range.add(columns[place]);
  return range;
}

// Returns true for whole numbers that grow from row to row: by one from 0 or 1, or by any steps
// over 16 rows. No surface has points with such first coordinates.
bool numbers_rows(const std::vector<double>& values) {
  constexpr std::size_t kFewRows = 4, kManyRows = 16;  // chosen
  if (values.size() < kFewRows) return false;
  bool by_one = values[0] == 0 || values[0] == 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(std::abs(values[i]) < 1e15) || values[i] != std::floor(values[i])) return false;
    if (i > 0 && values[i] <= values[i - 1]) return false;
    by_one = by_one && values[i] == values[0] + static_cast<double>(i);
  }
  return by_one || values.size() >= kManyRows;
}

// Properties of vectors in three columns that distinguish normals from colours.
struct Lengths {
  double min = std::numeric_limits<double>::infinity(), max = 0;
  bool unit = false;      // all have length 1, to 1 %
  bool negative = false;  // a component is negative
};

Vec3 vector_at(const Columns& columns, std::size_t first, std::size_t row) {
  return {columns[first][row], columns[first + 1][row], columns[first + 2][row]};
}

Lengths lengths_of(const Columns& columns, std::size_t first) {
  Lengths lengths;
  UnitVectors units;
  for (std::size_t i = 0; i < columns[first].size(); ++i) {
    const Vec3 v = vector_at(columns, first, i);
    if (!is_finite(v) || v == Vec3{}) continue;
    units.add(v);
    lengths.min = std::min(lengths.min, norm(v));
    lengths.max = std::max(lengths.max, norm(v));
    lengths.negative = lengths.negative || v.x < 0 || v.y < 0 || v.z < 0;
  }
  lengths.unit = units.all_are();
  return lengths;
}

// Returns the mean absolute cosine between each vector and the direction to the nearest point. It
// is 0 for normals of a surface and 1/2 for unrelated vectors.
double cosine_to_neighbors(const Columns& columns, std::size_t position, std::size_t first) {
  constexpr std::size_t kAsked = 200, kCompared = 20000;  // chosen: some milliseconds
  const std::size_t n = columns[first].size();
  const std::size_t step = std::max<std::size_t>(1, n / kAsked),
                    stride = std::max<std::size_t>(1, n / kCompared);
  double sum = 0;
  std::size_t counted_ones = 0;
  for (std::size_t i = 0; i < n; i += step) {
    const Vec3 p = vector_at(columns, position, i), v = vector_at(columns, first, i);
    if (!is_finite(p) || !is_finite(v) || v == Vec3{}) continue;
    Vec3 nearest{};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < n; j += stride) {
      const Vec3 way = vector_at(columns, position, j) - p;
      const double square = dot(way, way);
      if (square > 0 && square < least) {
        least = square;
        nearest = way;
      }
    }
    if (!std::isfinite(least)) continue;
    sum += std::abs(dot(v, nearest)) / (norm(v) * std::sqrt(least));
    ++counted_ones;
  }
  return counted_ones == 0 ? 1 : sum / static_cast<double>(counted_ones);
}

// Returns true if the columns may be latitudes and longitudes.
bool may_be_degrees(const Range& latitude, const Range& longitude) {
  return latitude.min >= -90 && latitude.max <= 90 && latitude.max - latitude.min > 90 &&
         longitude.min >= -180 && longitude.max <= 360 && longitude.max - longitude.min > 180;
}

// A grid in the usual order: one column is constant for runs of rows, in which the other column
// takes the same values each time. Both change by constant steps.
struct Raster {
  std::size_t n = 0;          // rows of a run; 0: no raster
  double fast = 0, slow = 0;  // the steps
  bool is() const { return n > 0; }
};

Raster raster_of(const std::vector<double>& slow, const std::vector<double>& fast) {
  constexpr std::size_t kLeast = 4;  // rows of a run, and runs: chosen
  constexpr double kStep = 0.01;     // steps are rounded when they are written; chosen
  const auto change =
      std::find_if(slow.begin(), slow.end(), [&](double v) { return v != slow[0]; });
  const auto n = static_cast<std::size_t>(change - slow.begin());
  if (n < kLeast || slow.size() < kLeast * n) return {};
  const Raster raster{.n = n, .fast = fast[1] - fast[0], .slow = slow[n] - slow[0]};
  const auto is_step = [](double a, double b, double step) {
    return std::abs(b - a - step) <= kStep * std::abs(step);
  };
  for (std::size_t i = 1; i < slow.size(); ++i) {
    const bool starts = i % n == 0;
    if (starts ? !is_step(slow[i - 1], slow[i], raster.slow) : slow[i] != slow[i - 1]) return {};
    if (i >= n ? fast[i] != fast[i % n] : !is_step(fast[i - 1], fast[i], raster.fast)) return {};
  }
  return raster;
}

// Returns true if rows are on a grid of latitudes and longitudes whose faster angle covers the full
// circle, or runs from pole to pole. A large table may have been read in part.
bool are_degree_grid(const std::vector<double>& latitudes, const std::vector<double>& longitudes) {
  const Range latitude = range_of({latitudes}, {0}), longitude = range_of({longitudes}, {0});
  if (latitude.min < -90 || latitude.max > 90 || longitude.min < -180 || longitude.max > 360)
    return false;
  constexpr double kRounded = 1.01;  // in steps, which are rounded when written; chosen
  if (const Raster rows = raster_of(latitudes, longitudes); rows.is()) {
    return longitude.max - longitude.min + kRounded * std::abs(rows.fast) >= 360 &&
           std::abs(latitudes[0]) + kRounded * std::abs(rows.slow) >= 90;
  }
  const Raster columns = raster_of(longitudes, latitudes);
  return columns.is() &&
         std::max(90 - latitude.max, latitude.min + 90) <= kRounded * std::abs(columns.fast);
}

// ---- The plan ----

class Planner {
 public:
  Planner(const TableHeader& header, const TellingRows& telling, const TableHints& hints)
      : header_(header), telling_(telling), columns_(telling.columns), hints_(hints) {
    plan_.roles.assign(columns_.size(), Role::kScalar);
    plan_.names.resize(columns_.size());
    remarks_ = header.remarks;
  }

  TablePlan by_user(const std::string& wanted) {
    Asked asked = parse_columns(wanted);
    if (asked.roles.size() != columns_.size()) {
      refuse("columns " + in_quotes(wanted) + " are " + std::to_string(asked.roles.size()) +
             ", but the rows have " + counted(columns_.size(), "value", "values"));
    }
    plan_.roles = std::move(asked.roles);
    plan_.names = std::move(asked.names);
    return finish("as asked for");
  }

  TablePlan by_names() {
    const NamedRoles named = named_roles(header_.names);
    if (!named.has_position()) {
      refuse(
          "the header names no columns x, y, z (nor lat, lon, radius); --columns, or columns= in "
          "Python, says which they are");
    }
    plan_.roles = named.roles;
    plan_.colatitude = named.colatitude;
    plan_.west = named.west;
    plan_.radians = named.radians;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const bool nameless = header_.names[k].empty();
      if (nameless && k > 0 && !numbers_rows(columns_[k])) plan_.roles[k] = Role::kScalar;
      if (nameless && plan_.roles[k] == Role::kSkipped) {
        remarks_.push_back("column " + std::to_string(k + 1) + " has no name and is passed over");
      }
      if (plan_.roles[k] == Role::kScalar) plan_.names[k] = header_.names[k];
      if (telling_.texts[k] > 0 && telling_.texts[k] == used(k)) pass_over_text(k);
    }
    look_for_radians();
    return finish("by the names in the header");
  }

  TablePlan by_values() {
    std::vector<std::size_t> free, empty;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (telling_.texts[k] > 0 && telling_.texts[k] == used(k)) {
        pass_over_text(k);
        continue;
      }
      if (used(k) > 0) free.push_back(k);
      if (used(k) == 0) empty.push_back(k);
    }
    if (free.size() < 3) {  // rows without numbers are dropped later
      free.insert(free.end(), empty.begin(), empty.end());
      std::sort(free.begin(), free.end());
    } else {
      for (const std::size_t k : empty) plan_.roles[k] = Role::kSkipped;
    }
    if (free.size() > 3 && numbers_rows(columns_[free[0]])) {
      plan_.roles[free[0]] = Role::kSkipped;
      remarks_.push_back("column " + std::to_string(free[0] + 1) + " numbers the rows");
      free.erase(free.begin());
    }
    if (free.size() < 3) {
      refuse("a point needs 3 coordinates, here are " + counted(free.size(), "column", "columns") +
             " of numbers");
    }
    for (std::size_t k = 0; k < 3; ++k) plan_.roles[free[k]] = static_cast<Role>(k);
    look_for_degrees(free[0], free[1], free[2]);
    take_rest({free.begin() + 3, free.end()}, free[0], free[2] == free[0] + 2);
    return finish("by their values");
  }

 private:
  // Returns the number of cells in the first rows that are not missing.
  std::size_t used(std::size_t k) const {
    return static_cast<std::size_t>(std::count_if(columns_[k].begin(), columns_[k].end(),
                                                  [](double v) { return !std::isnan(v); })) +
           telling_.texts[k];
  }

  void pass_over_text(std::size_t k) {
    if (static_cast<int>(plan_.roles[k]) < static_cast<int>(Role::kScalar))
      return;  // the reader reports it
    plan_.roles[k] = Role::kSkipped;
    const std::string name = k < header_.names.size() && !header_.names[k].empty()
                                 ? in_quotes(header_.names[k])
                                 : std::to_string(k + 1);
    remarks_.push_back("column " + name + " is text and is passed over");
  }

  void look_for_radians() {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (plan_.roles[k] != Role::kLatitude || plan_.radians || telling_.rows < 6) continue;
      const Range range = range_of(columns_, {k});
      if (std::max(-range.min, range.max) < 3.2) {
        plan_.told.unsure = true;
        remarks_.emplace_back("angles this small may be radians (which a unit in the header says)");
      }
    }
  }

  void look_for_degrees(std::size_t a, std::size_t b, std::size_t c) {
    const Range radius = range_of(columns_, {c});
    if (telling_.rows < 6 || !(radius.min > 0) || radius.max > 20 * radius.min) return;
    for (const auto& [latitude, longitude] : {std::pair(a, b), std::pair(b, a)}) {
      if (are_degree_grid(columns_[latitude], columns_[longitude])) {
        const std::string names = latitude == a ? "lat,lon,radius" : "lon,lat,radius";
        refuse(
            "the rows look like a grid of " +
            std::string(latitude == a ? "latitudes and longitudes" : "longitudes and latitudes") +
            " in degrees: say --columns " + names + " (columns= in Python), or x,y,z if they are" +
            " coordinates" + others());
      }
      if (may_be_degrees(range_of(columns_, {latitude}), range_of(columns_, {longitude}))) {
        suspect(std::string("they may be ") +
                (latitude == a ? "lat, lon, radius" : "lon, lat, radius") + " in degrees");
        return;
      }
    }
  }

  // Returns how the message describes columns after the first three.
  std::string others() const {
    return columns_.size() > 3 ? ", with a name, or -, for each other column" : "";
  }

  void take_rest(const std::vector<std::size_t>& rest, std::size_t position, bool side_by_side) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < rest.size();) {
      const std::size_t k = rest[i];
      const bool three = i + 2 < rest.size() && rest[i + 2] == k + 2 &&
                         !(is_free_of_colors() && before_colors(rest, i));
      if (three && is_free_of_normals() && are_normals(k, position, side_by_side, i == 0)) {
        take(k, Role::kNx);
        i += 3;
      } else if (three && is_free_of_colors() && are_colors(k)) {
        take(k, Role::kRed);
        i += 3;
        if (i < rest.size() && is_alpha(rest[i], k)) plan_.roles[rest[i++]] = Role::kAlpha;
      } else {
        plan_.names[k] = "scalar_" + std::to_string(++number);
        ++i;
      }
    }
  }

  bool has(Role role) const {
    return std::find(plan_.roles.begin(), plan_.roles.end(), role) != plan_.roles.end();
  }
  bool is_free_of_normals() const { return !has(Role::kNx); }
  bool is_free_of_colors() const { return !has(Role::kRed); }

  void take(std::size_t first, Role role) {
    for (std::size_t k = 0; k < 3; ++k) {
      plan_.roles[first + k] = static_cast<Role>(static_cast<int>(role) + static_cast<int>(k));
    }
  }

  // Tells a number before colours: PTS files have an intensity there, which may be a byte, too.
  bool before_colors(const std::vector<std::size_t>& rest, std::size_t i) {
    if (i != 0 || rest.size() != 4 || rest[3] != rest[0] + 3) return false;
    const Range all = range_of(columns_, {rest[0], rest[1], rest[2], rest[3]});
    const Range last = range_of(columns_, {rest[3]});
    if (!all.whole || all.min < 0 || all.max > 255 || all.max <= 1) return false;
    if (last.min == 255 || last.min == last.max) return false;  // an alpha, or a label
    if (!hints_.intensity_first) suspect("a scalar may come before the colours");
    return hints_.intensity_first;
  }

  bool are_normals(std::size_t k, std::size_t position, bool side_by_side, bool first) {
    constexpr std::size_t kRows = 8;  // fewer vectors may have these lengths by chance; chosen
    if (first && hints_.normals_follow) return true;
    const Lengths lengths = lengths_of(columns_, k);
    const bool many = telling_.rows >= kRows;
    constexpr double kNormals = 0.35;  // 7 standard deviations of 200 values below 1/2
    const auto across = [&](double most) {
      return many && side_by_side && cosine_to_neighbors(columns_, position, k) < most;
    };
    if (lengths.unit) {
      // Colours with one channel only are unit vectors, too.
      return lengths.negative || !many || across(kNormals);
    }
    const bool nearly = lengths.min >= 0.75 && lengths.max <= 1.25 && lengths.max > 0;
    if (nearly && many && lengths.negative) {
      remarks_.push_back("normals of length " + short_number(lengths.min) + " ... " +
                         short_number(lengths.max));
      return true;
    }
    if (lengths.negative && lengths.max > 0 && across(0.1)) {
      suspect("columns " + std::to_string(k + 1) + " ... " + std::to_string(k + 3) +
              " may be normals of other lengths");
    }
    return false;
  }

  bool are_colors(std::size_t k) {
    const Range all = range_of(columns_, {k, k + 1, k + 2});
    if (all.n == 0 || all.min < 0) return false;
    if (all.whole && all.max > 1) return all.max <= 255;
    if (all.max > 1) return false;
    suspect("columns " + std::to_string(k + 1) + " ... " + std::to_string(k + 3) +
            " are 0 ... 1 and may be scalars");
    return true;
  }

  // Returns true if the column after colours is alpha: constant, with the largest possible value.
  bool is_alpha(std::size_t place, std::size_t colors) {
    const Range alpha = range_of(columns_, {place});
    const Range rgb = range_of(columns_, {colors, colors + 1, colors + 2});
    return alpha.n > 0 && alpha.min == alpha.max &&
           alpha.max == (rgb.whole && rgb.max > 1 ? 255 : 1);
  }

  void suspect(const std::string& what) {
    plan_.told.unsure = true;
    remarks_.push_back(what + " (--columns says it)");
  }

  TablePlan finish(const char* how) {
    settle_colors();
    if (has(Role::kLatitude)) {
      remarks_.push_back(std::string(plan_.colatitude ? "colatitude" : "latitude") + " and " +
                         (plan_.west ? "west" : "east") + " longitude in " +
                         (plan_.radians ? "radians" : "degrees") + " become x, y, z");
    }
    tell(how);
    return std::move(plan_);
  }

  void settle_colors() {
    Range rgb;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const Role role = plan_.roles[k];
      if (role == Role::kRed || role == Role::kGreen || role == Role::kBlue) rgb.add(columns_[k]);
    }
    plan_.byte_colors = rgb.n > 0 && rgb.whole && rgb.min >= 0 && rgb.max > 1 && rgb.max <= 255;
    if (rgb.n > 0 && rgb.min >= 0 && rgb.max <= 1) remarks_.emplace_back("colours 0 ... 1");
  }

  void tell(const char* how) {
    constexpr std::size_t kShown = 24;
    std::string list;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const Role role = plan_.roles[k];
      std::string& name = plan_.names[k];
      if (role != Role::kScalar) name.clear();
      if (role == Role::kScalar && name.empty()) name = "column_" + std::to_string(k + 1);
      const std::string taken = role == Role::kScalar ? name : to_string(role);
      plan_.told.columns.push_back(
          {k < header_.names.size() ? header_.names[k] : std::string(), taken});
      if (k < kShown)
        list += (k > 0 ? ", " : "") + (role == Role::kScalar ? in_quotes(taken) : taken);
    }
    if (columns_.size() > kShown) list += ", ... (" + std::to_string(columns_.size()) + " in all)";
    plan_.told.note = "columns taken for " + list + " " + how;
    for (const std::string& remark : remarks_) plan_.told.note += "; " + remark;
  }

  const TableHeader& header_;
  const TellingRows& telling_;
  const Columns& columns_;
  TableHints hints_;
  TablePlan plan_;
  std::vector<std::string> remarks_;
};

}  // namespace

void UnitVectors::add(const Vec3& v) {
  if (v == Vec3{}) return;
  (std::abs(norm(v) - 1) <= 0.01 ? some_ : other_) = true;
}

void XyzNames::add(const Vec3& point, const Vec3& normal) {
  units_.add(normal);
  negative_ = negative_ || normal.x < 0 || normal.y < 0 || normal.z < 0;
  const bool grows = point.x == std::floor(point.x) && (n_ == 0 || point.x > last_);
  counts_ = counts_ && grows;
  last_ = point.x;
  ++n_;
}

void check_columns(const std::string& columns) {
  if (!columns.empty()) parse_columns(columns);
}

TablePlan plan_table(const TableHeader& header, const TellingRows& telling,
                     const std::string& wanted, const TableHints& hints) {
  Planner planner(header, telling, hints);
  if (!wanted.empty()) return planner.by_user(wanted);
  return header.names.empty() ? planner.by_values() : planner.by_names();
}

PointColumns::PointColumns(const TablePlan& plan, bool attributes) : plan_(plan) {
  constexpr std::array<const char*, 4> kColors = {"red", "green", "blue", "alpha"};
  for (std::size_t k = 0; k < plan.roles.size(); ++k) {
    const Role role = plan.roles[k];
    const int place = static_cast<int>(role);
    if (role <= Role::kZ) position_[static_cast<std::size_t>(place)] = k;
    if (role >= Role::kNx && role <= Role::kNz) {
      normal_[static_cast<std::size_t>(place - static_cast<int>(Role::kNx))] = k;
      has_normals_ = true;
    }
    if (role >= Role::kLatitude && role <= Role::kRadius) {
      position_[static_cast<std::size_t>(place - static_cast<int>(Role::kLatitude))] = k;
      degrees_ = true;
    }
    if (!attributes) continue;
    if (role >= Role::kRed && role <= Role::kAlpha) {
      const auto channel = static_cast<std::size_t>(place - static_cast<int>(Role::kRed));
      kept_.push_back({k,
                       {.name = kColors[channel],
                        .type = plan.byte_colors ? ScalarType::kUint8 : ScalarType::kFloat64}});
    } else if (role == Role::kScalar) {
      kept_.push_back({k, {.name = plan.names[k], .type = ScalarType::kFloat64}});
    }
  }
}

void PointColumns::add(std::span<const double> row) {
  Vec3 p = {row[position_[0]], row[position_[1]], row[position_[2]]};
  if (degrees_) {
    const double unit = plan_.radians ? 1 : std::numbers::pi / 180;
    const double theta = plan_.colatitude ? p.x * unit : std::numbers::pi / 2 - p.x * unit;
    const double phi = (plan_.west ? -p.y : p.y) * unit;
    // Cosines of right angles are not 0 in floating point, and each pole must be one point.
    const double sine = std::abs(std::abs(std::cos(theta)) - 1) < 1e-15 ? 0 : std::sin(theta);
    p = {p.z * sine * std::cos(phi), p.z * sine * std::sin(phi), p.z * std::cos(theta)};
  }
  points_.push_back(p);
  if (has_normals_) normals_.push_back({row[normal_[0]], row[normal_[1]], row[normal_[2]]});
  for (Kept& kept : kept_) kept.attribute.values.push_back(row[kept.column]);
}

PointCloud PointColumns::take() {
  PointCloud cloud;
  cloud.points = std::move(points_);
  cloud.normals = std::move(normals_);
  // Colours come first, in their order, for any order of the columns.
  std::stable_sort(kept_.begin(), kept_.end(), [&](const Kept& a, const Kept& b) {
    return plan_.roles[a.column] < plan_.roles[b.column];
  });
  for (Kept& kept : kept_) {
    cloud.attributes.push_back(std::move(kept.attribute));
    kept.attribute.values.clear();
  }
  return cloud;
}

std::size_t drop_not_finite(PointCloud& cloud) {
  for (Vec3& normal : cloud.normals) {
    if (!is_finite(normal)) normal = {};
  }
  const std::size_t before = cloud.points.size();
  const auto bad = static_cast<std::size_t>(std::count_if(
      cloud.points.begin(), cloud.points.end(), [](const Vec3& p) { return !is_finite(p); }));
  if (bad == 0) return 0;
  const auto squeeze = [&](auto& values) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (is_finite(cloud.points[i])) values[n++] = values[i];
    }
    values.resize(n);
  };
  squeeze(cloud.normals);
  for (Attribute& attribute : cloud.attributes) squeeze(attribute.values);
  std::erase_if(cloud.points, [](const Vec3& p) { return !is_finite(p); });
  return before - cloud.points.size();
}

std::string dropped_warning(std::size_t n) {
  return counted(n, "point", "points") + " with a coordinate that is not a finite number dropped";
}

PointCloud points_of_rows(std::span<const double> rows, std::size_t width,
                          const std::string& columns, TableColumns* table) {
  if (width < 3)
    refuse("a point needs 3 coordinates, here are " + counted(width, "column", "columns"));
  const std::size_t n = rows.size() / width;
  constexpr std::size_t kTelling = 65536;  // chosen, as for texts
  TellingRows telling{.columns = std::vector<std::vector<double>>(width),
                      .texts = std::vector<std::size_t>(width)};
  telling.rows = std::min(n, kTelling);
  for (std::size_t k = 0; k < width; ++k) {
    for (std::size_t i = 0; i < telling.rows; ++i)
      telling.columns[k].push_back(rows[i * width + k]);
  }
  TableHeader header;
  header.syntax.columns = width;
  TablePlan plan;
  if (n == 0 && columns.empty()) {
    refuse("an array without rows does not tell what its " + std::to_string(width) +
           " columns are");
  }
  plan = plan_table(header, telling, columns, {});
  PointColumns points(plan, true);
  for (std::size_t i = 0; i < n; ++i) points.add(rows.subspan(i * width, width));
  PointCloud cloud = points.take();
  std::vector<std::string> ignored;
  settle_attribute_types(cloud.attributes, ignored);
  if (table != nullptr) *table = std::move(plan.told);
  return cloud;
}

}  // namespace rholm
