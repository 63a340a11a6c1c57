#include "io/shapes/column_names.h"

#include <algorithm>
#include <array>
#include <optional>

namespace rholm {
namespace {

using Role = ColumnRole;

template <std::size_t kSize>
bool is_one_of(std::string_view word, const std::array<std::string_view, kSize>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 31> kUnits = {
    "m",      "mm",     "cm",    "dm",     "km",      "um",      "nm",     "in",
    "inch",   "ft",     "deg",   "degree", "degrees", "rad",     "radian", "radians",
    "meter",  "meters", "metre", "metres", "pixel",   "pixels",  "px",     "voxel",
    "voxels", "vox",    "au",    "mu",     "micron",  "microns", "units"};
constexpr std::array<std::string_view, 18> kPointWords = {
    "point",  "points",     "pos",         "position", "positions", "coord",
    "coords", "coordinate", "coordinates", "p",        "pt",        "location",
    "loc",    "vertex",     "vertices",    "xyz",      "centroid",  "axis"};
constexpr std::array<std::string_view, 6> kNormalWords = {"normal", "normals", "n",
                                                          "norm",   "nrm",     "nor"};
constexpr std::array<std::string_view, 8> kColorWords = {"color", "colors", "colour",  "colours",
                                                         "rgb",   "rgba",   "diffuse", "col"};

// The words of a name without its unit, and the unit.
struct PlainName {
  std::vector<std::string> words;
  std::string unit;
};

PlainName plain_name(const std::string& name) {
  PlainName plain;
  const std::string all = lower_case(name);
  std::string_view text = all;
  if (const std::size_t at = text.find_first_of("([{<"); at != std::string_view::npos) {
    std::string_view unit = text.substr(at + 1);
    plain.unit = unit.substr(0, unit.find_first_of(")]}>"));
    text = text.substr(0, at);
  } else if (const std::size_t slash = text.find('/');
             slash != std::string_view::npos && slash > 0) {
    plain.unit = text.substr(slash + 1);
    text = text.substr(0, slash);
  }
  std::string word;
  const auto put = [&] {
    if (!word.empty()) plain.words.push_back(word);
    word.clear();
  };
  for (const char c : text) {
    constexpr std::string_view kBetween = " \t_.:-,;*'\"";
    kBetween.find(c) == std::string_view::npos ? word += c : (put(), word);
  }
  put();
  if (plain.words.size() > 1 && is_one_of(plain.words.back(), kUnits)) {
    plain.unit = plain.words.back();
    plain.words.pop_back();
  }
  return plain;
}

enum class Kind { kPoint, kNormal, kColor };

// Return the index of an axis or a channel, 0 ... 3.
std::optional<int> axis_of(std::string_view word) {
  for (int k = 0; k < 3; ++k) {
    if (word == std::string(1, static_cast<char>('x' + k)) || word == std::to_string(k)) return k;
  }
  return std::nullopt;
}
std::optional<int> channel_of(std::string_view word) {
  constexpr std::array<std::array<std::string_view, 3>, 4> kChannels = {
      {{"r", "red", "rf"}, {"g", "green", "gf"}, {"b", "blue", "bf"}, {"a", "alpha", "af"}}};
  for (std::size_t k = 0; k < kChannels.size(); ++k) {
    if (is_one_of(word, kChannels[k])) return static_cast<int>(k);
  }
  return std::nullopt;
}

Role role_of(Kind kind, int place) {
  const Role first = kind == Kind::kPoint    ? Role::kX
                     : kind == Kind::kNormal ? Role::kNx
                                             : Role::kRed;
  return static_cast<Role>(static_cast<int>(first) + place);
}

std::optional<Kind> kind_of(std::string_view word) {
  if (is_one_of(word, kPointWords)) return Kind::kPoint;
  if (is_one_of(word, kNormalWords)) return Kind::kNormal;
  if (is_one_of(word, kColorWords)) return Kind::kColor;
  return std::nullopt;
}

// Returns the role of one word for kind and axis or channel: "nx", "normalx", "xcoord", "posy".
std::optional<Role> role_of_compact(std::string_view word) {
  for (const bool behind : {true, false}) {
    if (word.size() < 2) break;
    const std::string_view place = behind ? word.substr(word.size() - 1) : word.substr(0, 1);
    const std::string_view rest = behind ? word.substr(0, word.size() - 1) : word.substr(1);
    const auto kind = kind_of(rest);
    if (!kind || (place[0] >= '0' && place[0] <= '9')) continue;
    const auto at = *kind == Kind::kColor ? channel_of(place) : axis_of(place);
    if (at && (*kind != Kind::kPoint || rest.size() > 1)) return role_of(*kind, *at);
  }
  return std::nullopt;
}

// Returns the role that the words of one name have, independently of other names.
std::optional<Role> role_of_words(const std::vector<std::string>& words) {
  if (words.empty() || words.size() > 3) return std::nullopt;
  if (words.size() == 1) {
    const std::string& word = words[0];
    if (const auto axis = axis_of(word); axis && word[0] >= 'x')
      return role_of(Kind::kPoint, *axis);
    if (const auto channel = channel_of(word)) return role_of(Kind::kColor, *channel);
    return role_of_compact(word);
  }
  std::optional<Kind> kind;
  std::optional<int> axis, channel;
  for (const std::string& word : words) {
    const auto found = kind_of(word);
    if (found && (!kind || *kind == Kind::kPoint)) {
      kind = found;
    } else if (!found && !axis && !channel && (axis_of(word) || channel_of(word))) {
      axis = axis_of(word);
      channel = channel_of(word);
    } else if (!found) {
      return std::nullopt;
    }
  }
  if (!kind) return std::nullopt;
  const bool digit = axis && !channel && *kind == Kind::kColor;  // "RGB:0"
  const auto place = *kind == Kind::kColor && !digit ? channel : axis;
  return place ? std::optional(role_of(*kind, *place)) : std::nullopt;
}

enum class Geo { kLatitude, kColatitude, kLongitude, kRadius, kEast, kNorth, kHeight };

std::optional<Geo> geo_of(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "lat" || word == "latitude" || word == "lats") return Geo::kLatitude;
    if (word == "colat" || word == "colatitude") return Geo::kColatitude;
    if (word == "lon" || word == "long" || word == "lng" || word == "longitude" || word == "lons") {
      return Geo::kLongitude;
    }
    if (word == "r" || word == "rad" || word == "radius" || word == "radii" || word == "rho") {
      return Geo::kRadius;
    }
    if (word == "easting" || word == "east") return Geo::kEast;
    if (word == "northing" || word == "north") return Geo::kNorth;
    if (word == "height" || word == "elevation" || word == "elev" || word == "altitude" ||
        word == "alt" || word == "z" || word == "h") {
      return Geo::kHeight;
    }
  }
  return std::nullopt;
}

class NameReader {
 public:
  explicit NameReader(const std::vector<std::string>& names) : names_(names) {
    for (const std::string& name : names) plain_.push_back(plain_name(name));
    result_.roles.assign(names.size(), Role::kScalar);
  }

  NamedRoles read() {
    if (!take_group({Role::kX, Role::kY, Role::kZ}) && !take_degrees()) take_map();
    take_group({Role::kNx, Role::kNy, Role::kNz});
    if (take_group({Role::kRed, Role::kGreen, Role::kBlue})) take_group({Role::kAlpha});
    for (std::size_t k = 0; k < names_.size(); ++k) {  // pandas: an index that was read and written
      const std::string name = lower_case(names_[k]);
      if (name.empty() || name.starts_with("unnamed:")) result_.roles[k] = Role::kSkipped;
    }
    return result_;
  }

 private:
  bool is_free(std::size_t k) const { return result_.roles[k] == Role::kScalar; }

  // Finds the column of a role: a name equal to the role, otherwise the first with this meaning.
  std::optional<std::size_t> find(Role role) const {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (!is_free(k) || role_of_words(plain_[k].words) != role) continue;
      if (lower_case(names_[k]) == to_string(role)) return k;
      if (!found) found = k;
    }
    return found;
  }

  // Takes columns for all of the roles, or for none.
  bool take_group(const std::vector<Role>& roles) {
    std::vector<std::size_t> places;
    for (const Role role : roles) {
      const auto place = find(role);
      if (!place) return false;
      places.push_back(*place);
    }
    for (std::size_t i = 0; i < roles.size(); ++i) result_.roles[places[i]] = roles[i];
    return true;
  }

  std::optional<std::size_t> find_geo(std::initializer_list<Geo> wanted) const {
    for (std::size_t k = 0; k < names_.size(); ++k) {
      const auto geo = geo_of(plain_[k].words);
      if (geo && std::find(wanted.begin(), wanted.end(), *geo) != wanted.end()) return k;
    }
    return std::nullopt;
  }

  bool has_word(std::size_t k, std::string_view word) const {
    const auto& words = plain_[k].words;
    return std::find(words.begin(), words.end(), word) != words.end();
  }

  bool take_degrees() {
    const auto latitude = find_geo({Geo::kLatitude, Geo::kColatitude});
    const auto longitude = find_geo({Geo::kLongitude});
    const auto radius = find_geo({Geo::kRadius});
    if (!latitude || !longitude || !radius) return false;
    const bool is_red =
        lower_case(names_[*radius]) == "r" && find(Role::kGreen) && find(Role::kBlue);
    if (is_red) return false;
    result_.roles[*latitude] = Role::kLatitude;
    result_.roles[*longitude] = Role::kLongitude;
    result_.roles[*radius] = Role::kRadius;
    result_.colatitude = geo_of(plain_[*latitude].words) == Geo::kColatitude;
    result_.west = has_word(*longitude, "west") || has_word(*longitude, "w") ||
                   plain_[*longitude].unit.ends_with('w') ||
                   plain_[*longitude].unit.find("west") != std::string::npos;
    result_.radians = plain_[*latitude].unit.starts_with("rad");
    return true;
  }

  void take_map() {
    const auto east = find_geo({Geo::kEast});
    const auto north = find_geo({Geo::kNorth});
    const auto height = find_geo({Geo::kHeight});
    if (!east || !north || !height) return;
    result_.roles[*east] = Role::kX;
    result_.roles[*north] = Role::kY;
    result_.roles[*height] = Role::kZ;
  }

  const std::vector<std::string>& names_;
  std::vector<PlainName> plain_;
  NamedRoles result_;
};

}  // namespace

const char* to_string(ColumnRole role) {
  constexpr std::array<const char*, 15> kNames = {
      "x", "y", "z", "nx", "ny", "nz", "r", "g", "b", "a", "lat", "lon", "radius", "scalar", "-"};
  return kNames[static_cast<std::size_t>(role)];
}

bool NamedRoles::has_position() const {
  const auto has = [&](Role role) {
    return std::find(roles.begin(), roles.end(), role) != roles.end();
  };
  return has(Role::kX) || has(Role::kLatitude);
}

NamedRoles named_roles(const std::vector<std::string>& names) { return NameReader(names).read(); }

bool has_position(const std::vector<std::string>& names) {
  return names.size() >= 3 && named_roles(names).has_position();
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

}  // namespace rholm
