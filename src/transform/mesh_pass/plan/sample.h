// Samples some of a mesh's faces, before a pass over all of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rholm/mesh_view.h"

namespace rholm {

// Faces spread over the mesh, in runs of neighbours in the file's order; scaled lengths.
struct MeshSample {
  // Errors in units of lumping_error(L): see TriangleBlock.
  struct Entry {
    double error2;        // the face's own error, with its edges: it decides in the pass
    double face_error2;   // (F z^4)^2
    double face_weight2;  // F^2
  };
  // An edge whose two faces are in the sample: error2 of the faces, the lower first; W z^4 of the
  // half-edges in the same order; W of both together.
  struct Edge {
    double lower2, upper2;
    double lower, upper;
    double weight;
  };
  std::vector<Entry> entries;
  std::vector<Edge> edges;
  // Data of a face for rules with Hessians: W and z^2 of the half-edges, see kHermiteBend, and F.
  // `twins` are the half-edges 3 t + i that belong to one edge.
  struct Triangle {
    std::array<double, 3> weight, z2;
    double face;
  };
  std::vector<Triangle> faces;
  std::vector<std::array<std::uint32_t, 2>> twins;
  double edge_share = 0;  // edges of the mesh per edge of the sample; 0: none is known
  // Energy of the edges' errors relative to the faces', if no edge is known: as on smooth meshes.
  // On other meshes the pass finds more, and is repeated.
  double unseen_edges = 3;
  double scale = 1;       // a power of two that brings lengths to about 1
  double mean = 0;        // mean of r over directions
  double norm = 0;        // sqrt(int (r - mean)^2 dOmega)
  double share = 1;       // faces of the mesh per face of the sample
  bool overlaps = false;  // some faces are seen from behind
  double angle = 0;       // mean angle of an edge as seen from the centre
  double aligned = 0;     // share of the edges, by weight, along meridians or parallels
  // Estimates for the whole, known to some tens of per cent. They are sums over all sources that
  // are spread: edges in some three nodes or two lumps, faces in some six or three. Gradients count
  // about as much again.
  double source2 = 0;  // the sum of squares
  double modulus = 0;  // the sum of moduli
};
MeshSample sample_mesh(const MeshView& mesh, const Vec3& center, int degree);

}  // namespace rholm
