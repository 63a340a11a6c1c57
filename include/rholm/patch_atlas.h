// The paper's atlas (its sections 5.1 to 5.6), kept for comparison. Patches come from a kd-tree,
// each on its best-fitting sphere; coefficients are integrals over the Delaunay triangles of its
// points. Layer: model.
#pragma once

#include <cstddef>

#include "rholm/compress.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

// The paper's parameters.
struct PatchAtlasOptions {
  int degree = 16;                               // degree of every cap, 0 ... kMaxCapDegree
  CapExtension extension = CapExtension::kZero;  // values of caps outside of their points
  double min_cosine = 0.5;  // cosine of a normal to its patch's mean normal (P36), 0 ... 1
  // Enlarges a patch by surrounding points: radius of its cell over radius of its own points, 1 ...
  // 4. Caps have no weight at the rims of their cells, where their series are wrong.
  double overlap = 1.5;
};

// Lists the fields of PatchAtlasOptions (fields.h).
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

// The caps, and the surface extracted from them.
struct PatchAtlas {
  AtlasModel model;           // blended by the paper's weights; errors measured on its surface
  Mesh surface;               // surface with normals nx, ny, nz
  double rms_along_rays = 0;  // rms distance of the cells' points to their caps' series, (P42)
};

// Computes the paper's atlas. A mesh counts as its vertices with the mean normals of their faces;
// its errors are measured both ways, errors for points from the points only. Points need normals.
// Throws InvalidInput for bad options or no patch. Same bits for any number of threads.
PatchAtlas patch_atlas(const Mesh& mesh, const PatchAtlasOptions& options,
                       const Context& context = {});
PatchAtlas patch_atlas(const PointCloud& cloud, const PatchAtlasOptions& options,
                       const Context& context = {});

// A step before the expansion that patch_picture() shows (the paper's Figure 3).
enum class PatchView {
  kPatches,    // the points of each patch, joined by their Delaunay triangles on its sphere
  kTriangles,  // the same, but each triangle separate and smaller, so that gaps separate them
  kSpheres     // the same on the sphere of each patch: the directions where the series are fitted
};
EnumNames names_of(PatchView view);  // "patches", "triangles", "spheres"

// A mesh that shows patches, each patch in a colour of its own.
struct PatchPicture {
  Mesh mesh;                // mesh with red, green, blue; patches share no vertices
  std::size_t patches = 0;  // number of patches
};
// Makes the picture; ignores options.degree, extension and overlap. Throws as patch_atlas().
PatchPicture patch_picture(const Mesh& mesh, PatchView view, const PatchAtlasOptions& options = {},
                           const Context& context = {});
PatchPicture patch_picture(const PointCloud& cloud, PatchView view,
                           const PatchAtlasOptions& options = {}, const Context& context = {});

}  // namespace rholm
