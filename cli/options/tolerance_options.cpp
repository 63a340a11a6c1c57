#include "cli/options/tolerance_options.h"

#include "cli/grammar/parse.h"

namespace rholm::cli {

std::optional<Tolerance> ToleranceOptions::parsed() const {
  if (!tolerance) {
    if (!norm.empty() || !measure.empty() || !unit.empty() || max_degree) {
      throw UsageError("--norm, --measure, --unit and --max-degree go with --tolerance");
    }
    return std::nullopt;
  }
  Tolerance result;
  result.error = *tolerance;
  if (!norm.empty()) result.norm = parse_error_norm(norm);
  if (!unit.empty()) result.unit = parse_tolerance_unit(unit);
  // The diagonal is a size of the object in space, the mean radius one of the function.
  if (result.unit == ToleranceUnit::kDiagonal) result.measure = ErrorMeasure::kDistance;
  if (!measure.empty()) result.measure = parse_error_measure(measure);
  if (max_degree) result.max_degree = *max_degree;
  return result;
}

std::vector<Option> tolerance_options(ToleranceOptions& o) {
  return {{.name = "tolerance",
           .value = "E",
           .help = "the smallest degree whose error is at most E, instead of --degree; exit code "
                   "4 if --max-degree does not keep it",
           .target = &o.tolerance,
           .above = 0},
          {.name = "norm",
           .help = "of the tolerance: rms (the default) or max, the largest error",
           .target = &o.norm,
           .choices = {"rms", "max"}},
          {.name = "measure",
           .help = "of the tolerance: radius, along rays from the centre, its rms over solid "
                   "angle; distance, between the surfaces, its rms over area; radius by default, "
                   "distance with --unit diagonal",
           .target = &o.measure,
           .choices = {"radius", "distance"}},
          {.name = "unit",
           .help = "of the tolerance: absolute (the default), the shape's own; diagonal, of its "
                   "bounding box; radius, its mean over directions",
           .target = &o.unit,
           .choices = {"absolute", "diagonal", "radius"}},
          {.name = "max-degree",
           .value = "L",
           .help = "the largest degree that is tried for a tolerance; 1024 by default",
           .target = &o.max_degree,
           .min = 0,
           .max = kMaxDegree}};
}

}  // namespace rholm::cli
