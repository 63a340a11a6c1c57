// Levels of detail of a model of caps (method 7.8). Layer: model, private.
#pragma once

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// The caps of an atlas with no degree above `degree`, fitted to its own surface so that they agree
// where they meet, as far as so few degrees can.
Atlas level_of(const Atlas& atlas, int degree, const Mesh& surface, const Context& context);

}  // namespace rholm
