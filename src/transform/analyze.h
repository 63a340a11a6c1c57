// What `analyze` is made of, for those who have no chart, no need of norms, or a method of their
// own. Layer: transform.
#pragma once

#include "rholm/analyze.h"
#include "rholm/context.h"
#include "rholm/star.h"
#include "transform/mesh_pass/pass.h"
#include "transform/methods/methods.h"

namespace rholm {

RadialFunction function_of(Method method);
// `analyze` by `method`, the direct sums of options.method (used unless uses_mesh_pass()).
Analysis analyze_by(MethodFunction method, const StarChart& chart, const AnalyzeOptions& options,
                    const Context& context);
// The coefficients alone.
Analysis analyze_without_norms(MethodFunction method, const StarChart& chart,
                               const AnalyzeOptions& options, const Context& context);
void check(const AnalyzeOptions& options);
bool uses_mesh_pass(const AnalyzeOptions& options);
void set_pass(MeshPassResult& pass, Analysis& analysis);
// Of a pass with that precision alone.
Analysis analysis_of(MeshPassResult pass, double precision);
// All else that is known of the expansion but its norms.
void finish_analysis(const AnalyzeOptions& options, const Vec3& center, Analysis& analysis);
// The relative error of the coefficients, l2 without the mean.
double known_error(const Analysis& analysis);

}  // namespace rholm
