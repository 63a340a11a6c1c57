#include "model/encode/encoded_parts.h"

#include <utility>

#include "base/stopwatch.h"
#include "transform/analyze.h"

namespace rholm {

void set_found(ToleranceAnalysis found, const EncodeOptions& options, Encoded& encoded) {
  encoded.tolerance = ToleranceReport{.allowed = found.allowed,
                                      .reached = found.reached,
                                      .met = found.met,
                                      .degrees = std::move(found.degrees)};
  const StageTimes times = std::move(encoded.analysis.times);
  encoded.analysis = std::move(found.analysis);
  encoded.analysis.times.insert(times.begin(), times.end());
  if (!options.errors) encoded.analysis.expansion.errors.reset();
}

void add_errors(ErrorSites& sites, bool predict, const EncodeOptions& options,
                const Context& context, Encoded& encoded) {
  Analysis& analysis = encoded.analysis;
  if (!options.errors || analysis.expansion.errors) return;
  const double precision = known_error(analysis);
  analysis.expansion.errors = timed(encoded.times, "errors", [&] {
    return truncation_errors(analysis.expansion, {.precision = precision, .predict = predict},
                             sites, context);
  });
}

}  // namespace rholm
