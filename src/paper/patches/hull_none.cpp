// Replaces Qhull if rholm is built without it.
#include "paper/patches/hull_facets.h"
#include "rholm/error.h"

namespace rholm {

std::vector<Triangle> hull_facets(std::span<double>) {
  throw Error(
      ErrorCode::kUnsupported,
      "the paper's patches need Delaunay triangles by Qhull, which this rholm was built "
      "without (RHOLM_QHULL=OFF): build it with Qhull, or have caps fitted, not integrated");
}

}  // namespace rholm
