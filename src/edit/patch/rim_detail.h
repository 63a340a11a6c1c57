// Detail that a bridge takes along from its rim. Layer: edit.
#pragma once

#include "edit/patch/patch_blend.h"

namespace rholm {

// Fits bridge the points that site.ignored marks; what the surface around them has beyond the fits
// is carried in, as smooth as can be (least squares of the second difference, as a thin plate
// does): the moves of these points change so that they meet the surface where it is, with its
// slope. All others have no moves after that.
void carry_rim_detail(const Site& site, Blend& blend);

}  // namespace rholm
