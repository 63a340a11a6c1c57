#include "model/encode/prepare.h"

#include "shape/repair/thin_faces.h"

namespace rholm {

PreparedMesh prepare(const Mesh& mesh, double weld_tolerance) {
  PreparedMesh prepared{.shape = outward(mesh, weld_tolerance), .edges = {}};
  Mesh& welded = prepared.shape.welded.mesh;
  welded.attributes.clear();
  // Thin faces have random planes, which would distort slopes and errors.
  swap_thin_faces(welded);
  prepared.edges = pair_edges(welded);
  return prepared;
}

}  // namespace rholm
