// An expansion at the directions of a shape, for every degree. Layer: studio.
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

// Shown part of a series: degrees up to `degree`, each times its gain if there are gains.
struct Look {
  int degree = 0;
  std::vector<double> gains = {};  // gains of degrees 0 ... degree; empty: all 1
  friend bool operator==(const Look&, const Look&) = default;
};

struct Model {
  Expansion expansion;
  std::shared_ptr<const Mesh> original;  // shape of the model; nullptr if not available
  Mesh directions;                       // unit vectors from the centre, and triangles
  std::vector<Triangle> joined;          // joined_triangles() of the shape
  std::vector<double> base;  // function values at the directions: of the shape, if there is one
  std::optional<DegreeTable> table;  // set if it is small enough
  std::vector<double> power;         // energy of each degree
  // Errors of the radius when cut off at each degree, in the unit of lengths:
  // rms over solid angle, and largest at the vertices. Empty where unknown.
  std::optional<RmsBeyond> beyond;
  std::vector<double> max;
};

// Makes a model; throws the errors of synthesize(). Without a shape, the directions
// are an icosphere with two vertices per coefficient, as in `rholm synthesize`.
std::shared_ptr<const Model> make_model(Expansion expansion, std::shared_ptr<const Mesh> original,
                                        const Context& context = {});

// Returns the look that shows the whole model.
Look whole(const Model& model);
// Returns the gains of all degrees up to look.degree.
std::vector<double> gains_of(const Look& look);

// Returns the surface with its look, as the library makes it, with exact normals.
Mesh surface_of(const Model& model, const Look& look, const Context& context = {});
// Returns the expansion with its look: cut off, or filtered.
Expansion expansion_of(const Model& model, const Look& look);

// Surface for display, computed quickly; positions and normals are [n][3].
struct QuickSurface {
  std::vector<float> positions, normals;
  std::vector<float>
      error;  // [n], outside of the shape positive, along rays; empty without a shape
};
QuickSurface quick_surface(const Model& model, const Look& look, const Context& context = {});

// Returns the rms error of the radius, cut off at a degree: from the norm, or as
// measured, which exists only for all degrees together. Returns nullopt if it is unknown.
std::optional<double> rms_at(const Model& model, int degree);

}  // namespace rholm::studio
