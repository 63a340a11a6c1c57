// Levels of detail of a model of caps (method 7.8). Layer: model, private.
#pragma once

#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "surface/atlas_surface.h"

namespace rholm {

// The caps of an atlas without degrees above `degree`, fitted to the surface of the atlas so that
// they agree where they meet.
struct AtlasLevel {
  int degree = 0;
  Atlas atlas;
  double lost = 0;      // rms distance due to the degrees left out
  double ledges = 0;    // share of the surface that is tilted because caps disagree
  bool usable = false;  // ledges are hardly more than in the whole model
};

class LevelMaker {
 public:
  // Takes an atlas and its surface, which is not empty, and keeps references to both.
  LevelMaker(const Atlas& atlas, const Mesh& surface, const Context& context);
  // Returns the lowest usable level from `degree` on; the highest degree is always usable.
  AtlasLevel usable_from(int degree) const;
  // Returns the level of this degree. If its caps would show as separate plates, throws Unsupported
  // with the lowest usable degree.
  AtlasLevel usable_at(int degree) const;

 private:
  AtlasLevel at(int degree) const;

  const Atlas& atlas_;
  SampleLevels samples_;
  const Context& context_;
  double most_ledges_ = 0;
};

// Returns the surface of a level. Tries several bands for averaging caps until the surface has the
// topology of the whole model, and otherwise takes the closest topology.
Mesh level_surface(const Atlas& level, const Mesh& whole, const AtlasSurfaceOptions& options,
                   const Context& context);

}  // namespace rholm
