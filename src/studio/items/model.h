// An expansion on the directions of a shape, at every degree at once. Layer: studio.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/rms_beyond.h"
#include "studio/items/degree_table.h"

namespace rholm::studio {

// What of a series is shown: degrees up to `degree`, each times its gain if there are gains.
struct Look {
  int degree = 0;
  std::vector<double> gains = {};  // of degrees 0 ... degree; empty: all 1
  friend bool operator==(const Look&, const Look&) = default;
};

struct Model {
  Expansion expansion;
  std::shared_ptr<const Mesh> original;  // the shape it is of; nullptr if that is not there
  Mesh directions;                       // unit vectors from the centre, and triangles
  std::vector<Triangle> joined;          // joined_triangles() of the shape
  std::vector<double> base;  // the function at the directions: of the shape, if there is one
  std::optional<DegreeTable> table;  // where it fits
  std::vector<double> power;         // energy of each degree
  // Errors of the radius when cut off at each degree, in the unit of lengths: rms over solid angle,
  // largest at the vertices. Empty where none are known.
  std::optional<RmsBeyond> beyond;
  std::vector<double> max;
};

// Throws what synthesize() throws. Without a shape: directions of an icosphere with two vertices a
// coefficient, as `rholm synthesize` takes them.
std::shared_ptr<const Model> make_model(Expansion expansion, std::shared_ptr<const Mesh> original,
                                        const Context& context = {});

// Everything of it.
Look whole(const Model& model);
// Gains of all degrees up to look.degree.
std::vector<double> gains_of(const Look& look);

// The surface with its look, as the library makes it, with exact normals.
Mesh surface_of(const Model& model, const Look& look, const Context& context = {});
// The expansion with its look: cut off, or filtered.
Expansion expansion_of(const Model& model, const Look& look);

// The same surface for a screen, quickly: [n][3] each.
struct QuickSurface {
  std::vector<float> positions, normals;
  std::vector<float>
      error;  // [n], outside of the shape positive, along rays; empty without a shape
};
QuickSurface quick_surface(const Model& model, const Look& look, const Context& context = {});

// The rms error of the radius, cut off at a degree: by the norm, or as it was measured, which is
// known of all degrees together only. None where nobody knows it.
std::optional<double> rms_at(const Model& model, int degree);

}  // namespace rholm::studio
