// Adds detail from the rim of a region to its bridge. Layer: edit.
#pragma once

#include "edit/patch/patch_blend.h"

namespace rholm {

// Fits bridge the points that site.ignored marks. The difference between surface and
// fits around them continues into the bridge as smoothly as possible (least squares of
// the second difference, like a thin plate). The moves of these points change so that
// they meet the surface with its slope. All other points have no moves afterwards.
void carry_rim_detail(const Site& site, Blend& blend);

}  // namespace rholm
