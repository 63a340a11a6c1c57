// Pictures of the same panels from several sides.
#pragma once

#include <span>
#include <vector>

#include "rholm/render.h"

namespace rholm {

// As render(), a picture for each direction of sight in place of that of the options. What does not
// depend on it is made once: the tree of a panel's triangles takes a sixth of a picture's time.
std::vector<Image> render_views(std::span<const Panel> panels, const RenderOptions& options,
                                std::span<const Vec3> directions, const Context& context);

}  // namespace rholm
