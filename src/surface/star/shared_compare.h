// A comparison shared by several processes that have both surfaces.
#pragma once

#include "parts/executor.h"
#include "rholm/compare.h"
#include "rholm/context.h"
#include "surface/star/compare_samples.h"

namespace rholm {

// As compare() of the surfaces that the samples are of; parts are theirs, which another
// process measures by work() of its own samples of the same surfaces and options.
Comparison compare(CompareSamples& samples, const CompareOptions& options, const Context& context,
                   Executor& executor);

}  // namespace rholm
