// Draws pictures of the same panels from several sides.
#pragma once

#include <span>
#include <vector>

#include "rholm/render.h"

namespace rholm {

// Acts as render(), with one picture per direction in place of options.view. Data independent of
// the direction are made once: the tree of a panel's triangles takes a sixth of a picture's time.
std::vector<Image> render_views(std::span<const Panel> panels, const RenderOptions& options,
                                std::span<const Vec3> directions, const Context& context);

}  // namespace rholm
