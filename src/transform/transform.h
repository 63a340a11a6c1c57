// Steps of `expand()`, for callers that have no chart, need no norms, or have a method of their
// own. Layer: transform.
#pragma once

#include "rholm/context.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "transform/mesh_pass/pass.h"
#include "transform/methods/methods.h"

namespace rholm {

RadialFunction function_of(Method method);
// Runs `expand()` by `method`, the direct sums of options.method (unused if uses_mesh_pass()).
Transform expand_by(MethodFunction method, const StarChart& chart, const TransformOptions& options,
                    const Context& context);
// Computes the coefficients alone.
Transform expand_without_norms(MethodFunction method, const StarChart& chart,
                               const TransformOptions& options, const Context& context);
void check(const TransformOptions& options);
bool uses_mesh_pass(const TransformOptions& options);
void set_pass(MeshPassResult& pass, Transform& transform);
// Returns the transform of a pass of that precision, with nothing else set.
Transform transform_of(MeshPassResult pass, double precision);
// Sets all other properties of the expansion, except its norms.
void finish_transform(const TransformOptions& options, const Vec3& center, Transform& transform);
// Returns the relative l2 error of the coefficients without the mean.
double known_error(const Transform& transform);

}  // namespace rholm
