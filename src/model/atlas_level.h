// Levels of detail of a model of caps (method 7.8). Layer: model, private.
#pragma once

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "surface/atlas_surface.h"

namespace rholm {

// The caps of an atlas with no degree above `degree`, fitted to its own surface so that they agree
// where they meet. Throws Unsupported, with the least degree that will do, where they cannot and
// would stand beside each other as plates.
Atlas level_of(const Atlas& atlas, int degree, const Mesh& surface, const Context& context);

// The surface of a level; connected as the surface of the whole model is, if a band can be found
// within which caps are averaged so.
Mesh level_surface(const Atlas& level, const Mesh& whole, const AtlasSurfaceOptions& options,
                   const Context& context);

}  // namespace rholm
