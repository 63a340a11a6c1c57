#include "cli/options/tolerance_options.h"

#include "cli/grammar/parse.h"

namespace rholm::cli {

std::optional<Tolerance> ToleranceOptions::parsed() const {
  if (!tolerance) {
    if (!rest.names.empty()) {
      throw UsageError("--norm, --measure, --unit and --max-degree need --tolerance");
    }
    return std::nullopt;
  }
  Tolerance result = rest.values;
  result.error = *tolerance;
  // The diagonal measures the body in space; the mean radius measures the function.
  if (result.unit == ToleranceUnit::kDiagonal && !rest.has("measure")) {
    result.measure = ErrorMeasure::kDistance;
  }
  return result;
}

std::vector<Option> tolerance_options(ToleranceOptions& o) {
  std::vector<Option> list = {{.name = "tolerance",
                               .value = "E",
                               .help = "find the smallest degree whose error is at most E, instead "
                                       "of --degree; exit code 4 if --max-degree does not reach it",
                               .target = &o.tolerance,
                               .above = 0}};
  append(list, field_options(o.rest));
  return list;
}

}  // namespace rholm::cli
