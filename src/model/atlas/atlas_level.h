// Levels of detail of a model of caps (method 7.8). Layer: model, private.
#pragma once

#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "surface/atlas_surface.h"

namespace rholm {

// The caps of an atlas with no degree above `degree`, fitted to its own surface so that they agree
// where they meet.
struct AtlasLevel {
  int degree = 0;
  Atlas atlas;
  double lost = 0;      // rms distance that the degrees left out make
  double ledges = 0;    // share of the surface that leans because caps disagree
  bool usable = false;  // whether that is hardly more than of the whole model
};

class LevelMaker {
 public:
  // Of an atlas and its surface, which is not empty; both are referred to.
  LevelMaker(const Atlas& atlas, const Mesh& surface, const Context& context);
  // Of the least degree from `degree` on that is usable; the highest of the atlas always is.
  AtlasLevel usable_from(int degree) const;
  // Throws Unsupported, with the least degree that will do, for one whose caps would stand beside
  // each other as plates.
  AtlasLevel usable_at(int degree) const;

 private:
  AtlasLevel at(int degree) const;

  const Atlas& atlas_;
  SampleLevels samples_;
  const Context& context_;
  double most_ledges_ = 0;
};

// The surface of a level; connected as the surface of the whole model is, if a band can be found
// within which caps are averaged so, or as nearly as one that was tried.
Mesh level_surface(const Atlas& level, const Mesh& whole, const AtlasSurfaceOptions& options,
                   const Context& context);

}  // namespace rholm
