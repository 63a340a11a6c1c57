// Steps of `analyze`, for callers that have no chart, need no norms, or have a method of their own.
// Layer: transform.
#pragma once

#include "rholm/analyze.h"
#include "rholm/context.h"
#include "rholm/star.h"
#include "transform/mesh_pass/pass.h"
#include "transform/methods/methods.h"

namespace rholm {

RadialFunction function_of(Method method);
// Runs `analyze` by `method`, the direct sums of options.method (unused if uses_mesh_pass()).
Analysis analyze_by(MethodFunction method, const StarChart& chart, const AnalyzeOptions& options,
                    const Context& context);
// Computes the coefficients alone.
Analysis analyze_without_norms(MethodFunction method, const StarChart& chart,
                               const AnalyzeOptions& options, const Context& context);
void check(const AnalyzeOptions& options);
bool uses_mesh_pass(const AnalyzeOptions& options);
void set_pass(MeshPassResult& pass, Analysis& analysis);
// Returns the analysis of a pass of that precision, with nothing else set.
Analysis analysis_of(MeshPassResult pass, double precision);
// Sets all other properties of the expansion, except its norms.
void finish_analysis(const AnalyzeOptions& options, const Vec3& center, Analysis& analysis);
// Returns the relative l2 error of the coefficients without the mean.
double known_error(const Analysis& analysis);

}  // namespace rholm
