// The paper's atlas (its sections 5.1 to 5.6), kept to compare with: patches by a kd-tree, each on
// its best-fitting sphere, coefficients by integrals over the Delaunay triangles of its points.
// Layer: model.
#pragma once

#include <cstddef>

#include "rholm/compress.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

// The paper's parameters.
struct PatchAtlasOptions {
  int degree = 16;                               // of every cap, 0 ... kMaxCapDegree
  CapExtension extension = CapExtension::kZero;  // of caps beyond their points
  double min_cosine = 0.5;  // of normals to the mean normal of their patch (P36), 0 ... 1
  // A patch is widened by the points around it: the radius of its cell over that of its own points,
  // 1 ... 4. Caps have no weight at the rims of their cells, where their series are wrong.
  double overlap = 1.5;
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<PatchAtlasOptions>, const Visitor& field) {
  using O = PatchAtlasOptions;
  field(&O::degree, {.name = "degree",
                     .help = "degree of every cap",
                     .value = "L",
                     .least = 0,
                     .most = kMaxCapDegree,
                     .in_python = false});
  field(
      &O::extension,
      {.name = "extension",
       .help =
           "what a cap is beyond its points: zero, as the paper has it, or the sphere it lies on"});
  field(&O::min_cosine, {.name = "min_cosine",
                         .help = "least cosine between a normal and the mean normal of its patch",
                         .value = "C",
                         .least = 0,
                         .most = 1});
  field(&O::overlap, {.name = "overlap",
                      .help = "radius of the cell of a patch over that of its own points",
                      .value = "F",
                      .least = 1,
                      .most = 4,
                      .in_program = false});
}

// The caps, and the surface they make.
struct PatchAtlas {
  AtlasModel model;           // blended by the paper's weights; errors as measured on its surface
  Mesh surface;               // with normals nx, ny, nz
  double rms_along_rays = 0;  // of all points of the cells to the series of their caps, (P42)
};

// A mesh is its vertices, with the mean normals of their faces; its errors are measured both ways,
// those of points from the points. Points need normals. Throws InvalidInput for options out of
// range, and points that no patch can be made of. Same bits for any number of threads.
PatchAtlas patch_atlas(const Mesh& mesh, const PatchAtlasOptions& options,
                       const Context& context = {});
PatchAtlas patch_atlas(const PointCloud& cloud, const PatchAtlasOptions& options,
                       const Context& context = {});

// The steps before any expansion (the paper's Figure 3), each patch in a colour of its own.
enum class PatchView {
  kPatches,    // the points of each patch, joined by their Delaunay triangles on its sphere
  kTriangles,  // the same, each triangle by itself and smaller, so that gaps show them
  kSpheres     // the same on the sphere of each patch: what the series begin from
};
EnumNames names_of(PatchView view);  // "patches", "triangles", "spheres"

// Patches to look at.
struct PatchPicture {
  Mesh mesh;                // with red, green, blue; patches share no vertices
  std::size_t patches = 0;  // how many
};
// options.degree, extension and overlap are not used. Throws as patch_atlas().
PatchPicture patch_picture(const Mesh& mesh, PatchView view, const PatchAtlasOptions& options = {},
                           const Context& context = {});
PatchPicture patch_picture(const PointCloud& cloud, PatchView view,
                           const PatchAtlasOptions& options = {}, const Context& context = {});

}  // namespace rholm
