// The model file of an atlas, read. Layout: docs/model-file.md.
#include "reconstruct/file/atlas_read.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "io/file/bytes.h"
#include "io/hdf5/hdf5_values.h"
#include "reconstruct/file/atlas_crc32.h"
#include "reconstruct/file/atlas_pack.h"
#include "reconstruct/file/atlas_rules.h"
#include "reconstruct/file/model_file.h"
#include "rholm/error.h"

namespace rholm {
namespace {

class AtlasReader {
 public:
  AtlasReader(std::span<const char> bytes, const std::string& name)
      : file_(hdf5::open({bytes.data(), bytes.size()}, name)) {}

  AtlasModel read() const {
    const hdf5::Object root = hdf5::root_group(file_);
    check_model_version(file_, root);
    const hdf5::Object group = hdf5::open_member(file_, root, layout::kAtlas);
    const PackedAtlas packed = read_packed(group);
    AtlasModel model;
    const bool reconstructed = hdf5::has_member(file_, root, layout::kReconstruction);
    model.atlas = unpack(packed, file_.name, !reconstructed);
    const std::vector<double> scales = numbers(group, layout::kScales, layout::kScaleNumbers);
    model.step = scales[3], model.tolerance = scales[4];
    model.unit = text(group, layout::kUnit);
    model.method = text(group, layout::kMethod);
    model.input_numbers =
        static_cast<std::size_t>(std::min(numbers(group, layout::kInputNumbers, 1)[0], 1e18));
    if (hdf5::find_attribute(file_, group, layout::kAtlasErrors)) {
      const auto e = numbers(group, layout::kAtlasErrors, layout::kErrorNumbers);
      model.errors = AtlasErrors{e[0], e[1], e[2], e[3]};
    }
    check_crc32(group, atlas_crc32(packed));
    if (reconstructed) {
      read_rules(hdf5::open_member(file_, root, layout::kReconstruction), model);
    }
    return model;
  }

 private:
  [[noreturn]] void refuse(const std::string& what,
                           ErrorCode code = ErrorCode::kInvalidInput) const {
    throw Error(code, file_.name + ": " + what);
  }

  // Finite, and not below 0: all that are read so are lengths and counts.
  std::vector<double> numbers(const hdf5::Object& object, const char* name, std::size_t count,
                              double least = 0) const {
    const auto found = hdf5::find_attribute(file_, object, name);
    if (!found) refuse(fmt::format("'{}' has no attribute '{}'", object.path, name));
    std::vector<double> values = hdf5::to_doubles(file_, *found);
    if (values.size() != count) {
      refuse(fmt::format("the attribute '{}' has {} numbers instead of {}", name, values.size(),
                         count));
    }
    for (const double value : values) {
      if (value >= least && std::isfinite(value)) continue;
      refuse(fmt::format("the attribute '{}' holds {}", name, value));
    }
    return values;
  }
  std::string text(const hdf5::Object& object, const char* name) const {
    const auto found = hdf5::find_attribute(file_, object, name);
    return found ? hdf5::to_text(file_, *found) : std::string();
  }

  template <class T>
  std::vector<T> table(const hdf5::Object& group, const char* name, std::size_t columns) const {
    const hdf5::Array array = hdf5::read_dataset(file_, hdf5::open_member(file_, group, name));
    const auto& extents = array.extents;
    const bool fits =
        columns == 1 ? extents.size() == 1 : extents.size() == 2 && extents[1] == columns;
    if (!fits) {
      refuse(fmt::format("the shape of '{}' is ({}): it must have {} columns", array.path,
                         fmt::join(extents, ", "), columns));
    }
    return values_of<T>(array);
  }

  // Values in a table of floats that are not finite stay so; unpack() rejects them.
  template <class T>
  std::vector<T> values_of(const hdf5::Array& array) const {
    std::vector<T> result;
    if constexpr (std::numeric_limits<T>::is_integer) {
      for (const std::int64_t value : hdf5::to_integers(file_, array)) {
        if (value != static_cast<T>(value)) refuse(fmt::format("'{}' holds {}", array.path, value));
        result.push_back(static_cast<T>(value));
      }
    } else {
      for (const double value : hdf5::to_doubles(file_, array)) {
        // Out of the range of a float: a damaged file's, or a double's of another program.
        result.push_back(std::abs(value) <= std::numeric_limits<T>::max()
                             ? static_cast<T>(value)
                             : std::numeric_limits<T>::quiet_NaN());
      }
    }
    return result;
  }

  PackedAtlas read_packed(const hdf5::Object& group) const {
    PackedAtlas p;
    const std::string basis = text(group, layout::kBasis);
    if (basis != "even" && basis != "full") {
      refuse("its basis is '" + basis + "': even or full are known", ErrorCode::kUnsupported);
    }
    p.basis = basis == "even" ? CapBasis::kEven : CapBasis::kFull;
    const std::string blend = text(group, layout::kBlend);
    if (!blend.empty() && blend != to_string(CapBlend::kSmooth) &&
        blend != to_string(CapBlend::kSpline)) {
      refuse("its blend is '" + blend + "': smooth or spline are known", ErrorCode::kUnsupported);
    }
    p.blend = blend.empty() ? CapBlend::kSmooth : parse_name<CapBlend>(blend);
    p.caps = table<float>(group, layout::kCaps, kPackedCap);
    if (hdf5::has_member(file_, group, layout::kEllipses)) {
      p.ellipses = table<float>(group, layout::kEllipses, 5);
    }
    if (hdf5::has_member(file_, group, layout::kWeights)) {
      p.weights = table<float>(group, layout::kWeights, 1);
    }
    p.degrees = table<std::uint8_t>(group, layout::kDegrees, 1);
    p.kept = table<std::uint8_t>(group, layout::kKept, 1);
    p.values = table<std::int16_t>(group, layout::kValues, 1);
    constexpr double kAny = -std::numeric_limits<double>::max();
    const std::vector<double> origin = numbers(group, layout::kOrigin, 3, kAny);
    p.origin = {origin[0], origin[1], origin[2]};
    const std::vector<double> scales = numbers(group, layout::kScales, layout::kScaleNumbers);
    p.spacing = scales[0], p.noise = scales[1], p.band = scales[2];
    p.diagonal = numbers(group, layout::kDiagonal, 1)[0];
    p.weight_power = numbers(group, layout::kWeightPower, 1, kAny)[0];
    return p;
  }

  template <class T>
  std::vector<T> optional_table(const hdf5::Object& group, const char* name,
                                std::size_t columns) const {
    if (!hdf5::has_member(file_, group, name)) return {};
    return table<T>(group, name, columns);
  }

  void read_rules(const hdf5::Object& group, AtlasModel& model) const {
    PackedRules packed;
    packed.caps = table<double>(group, layout::kCaps, kExactCap);
    packed.coefficients = optional_table<double>(group, layout::kCoefficients, 1);
    packed.spacings = optional_table<double>(group, layout::kSpacings, kSpacingNumbers);
    packed.seen = optional_table<std::uint8_t>(group, layout::kSeen, 1);
    SurfaceRules& rules = model.rules.emplace();
    if (hdf5::has_member(file_, group, layout::kLeftOut)) {
      rules.left_out = hdf5::to_texts(
          file_, hdf5::read_dataset(file_, hdf5::open_member(file_, group, layout::kLeftOut)));
    }
    check_crc32(group, rules_crc32(packed, rules.left_out));
    const std::string holes = text(group, layout::kHoles);
    if (holes != to_string(HolePolicy::kFill) && holes != to_string(HolePolicy::kKeep)) {
      refuse("its holes are '" + holes + "': fill or keep are known", ErrorCode::kUnsupported);
    }
    rules.holes = parse_name<HolePolicy>(holes);
    rules.min_component = numbers(group, layout::kMinComponent, 1)[0];
    if (rules.min_component > 1) {
      refuse(fmt::format("its least component is {}: the file is damaged", rules.min_component));
    }
    rules.simplify = read_simplify(group);
    const auto tiles = hdf5::find_attribute(file_, group, layout::kTiles);
    rules.tiles = tiles && hdf5::to_integer(file_, *tiles) != 0;
    if (hdf5::find_attribute(file_, group, layout::kSeenFrame)) rules.seen = read_seen(group);
    unpack_caps(packed, file_.name, model.atlas);
    unpack_rules(std::move(packed), file_.name, rules);
  }

  std::optional<SimplifyOptions> read_simplify(const hdf5::Object& group) const {
    if (!hdf5::find_attribute(file_, group, layout::kSimplify)) return std::nullopt;
    const auto stops = numbers(group, layout::kSimplify, layout::kSimplifyNumbers, -1);
    if (stops[0] < 0 || stops[1] < 0 || stops[1] > 1) {
      refuse(fmt::format("it is simplified to {} faces and a share of {}: the file is damaged",
                         stops[0], stops[1]));
    }
    SimplifyOptions simplify{.faces = static_cast<std::size_t>(std::min(stops[0], 1e18)),
                             .share = stops[1]};
    if (stops[2] >= 0) simplify.max_error = stops[2];
    return simplify;
  }

  // Its frame: unpack_rules() has the bits.
  SeenCubes read_seen(const hdf5::Object& group) const {
    const auto frame = numbers(group, layout::kSeenFrame, layout::kSeenNumbers,
                               -std::numeric_limits<double>::max());
    SeenCubes seen{
        .origin = {frame[0], frame[1], frame[2]}, .edge = frame[3], .size = {}, .bits = {}};
    for (std::size_t k = 0; k < 3; ++k) {
      seen.size[k] = static_cast<std::size_t>(std::clamp(frame[4 + k], 0.0, 1e6));
    }
    return seen;
  }

  // Files of other programs need not have it.
  void check_crc32(const hdf5::Object& group, std::uint32_t found) const {
    const auto stored = hdf5::find_attribute(file_, group, layout::kCrc32);
    if (!stored || kAnyChecksum) return;
    if (hdf5::to_integer(file_, *stored) == found) return;
    refuse("its checksum is wrong: the file is damaged, or edited (then delete the attribute " +
           group.path + "@" + layout::kCrc32 + ")");
  }

  hdf5::File file_;
};

}  // namespace

AtlasModel parse_atlas(std::span<const char> bytes, const std::string& name) {
  check_model_signature(bytes, name);
  return AtlasReader(bytes, name).read();
}

AtlasModel read_atlas(const std::filesystem::path& path) {
  const Bytes bytes = read_bytes(path);
  return parse_atlas(bytes.view(), path == "-" ? "standard input" : path.string());
}

bool is_atlas_file(const std::filesystem::path& path) {
  if (path == "-" || !is_model_file(path)) return false;
  const Bytes bytes = read_bytes(path);
  const hdf5::File file = hdf5::open({bytes.view().data(), bytes.view().size()}, path.string());
  return hdf5::has_member(file, hdf5::root_group(file), layout::kAtlas);
}

}  // namespace rholm
