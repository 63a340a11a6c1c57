#include "cli/files/length_units.h"

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/files/paths.h"
#include "rholm/error.h"
#include "rholm/length_unit.h"

namespace rholm::cli {

void bring_to_unit(Expansion& expansion, const std::string& path, const std::string& unit,
                   const std::string& other_path, Session& session) {
  if (expansion.unit == unit) return;
  if (expansion.unit.empty() || unit.empty()) {
    const bool first = expansion.unit.empty();
    session.warn(fmt::format(
        "{} does not state its unit of length, and {} states {}; the same unit is assumed for both",
        display_name(first ? path : other_path), display_name(first ? other_path : path),
        first ? unit : expansion.unit));
    return;
  }
  const auto own = metres_of(expansion.unit), wanted = metres_of(unit);
  if (!own || !wanted) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("{} is in {} and {} is in {}, and the number of {} in one {} is unknown; write "
                    "both files in the same unit, with the same --length-unit",
                    display_name(path), expansion.unit, display_name(other_path), unit, unit,
                    expansion.unit));
  }
  if (*own != *wanted) {
    session.note(fmt::format(
        "{} is in {} and {} is in {}; the lengths of the first are multiplied by {:.15g}",
        display_name(path), expansion.unit, display_name(other_path), unit, *own / *wanted));
    expansion = scaled(expansion, *own / *wanted);
  }
  expansion.unit = unit;
}

void CommonUnit::add(Input& input, const std::string& path, Session& session) {
  auto* file = std::get_if<CoefficientsFile>(&input);
  if (!file) return;
  if (path_.empty()) {
    unit_ = file->expansion.unit;
    path_ = path;
  } else {
    bring_to_unit(file->expansion, path, unit_, path_, session);
  }
}

}  // namespace rholm::cli
