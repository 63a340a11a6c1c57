// The inner loops of the mesh pass (M8), which process one block of faces at a time.
//
// Notation of method 3e: corners p_0, p_1, p_2 relative to the centre, e_ij = p_j - p_i,
//   n = e_01 x e_02,  d2 = n . p_0,  W_ij = n . (p_i x p_j) / d2,  F = -n . n / d2.
// Hermite's rule (VG) lumps faces at the vertices: a vertex gets the weight 1/2 (W of both
// half-edges) + F/3. It gets the gradient (W/12 + F/24) e for both edge vectors e that leave it.
// With Hessians (VGH) the rules of hermite_rules.h have nodes between the vertices of long edges.
//
// Lumps are rounded to whole multiples of a quantum, so that their sums are exact. Sums are the
// same in any order and for any number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rholm/mesh_view.h"
#include "transform/rules/hermite_rules.h"
#include "transform/rules/plane_wave_rules.h"

namespace rholm {

inline constexpr std::size_t kTrianglesPerBlock = 128;  // chosen: 30 kB of work arrays

// Four numbers of a vertex, in quanta: weight and gradient x, y, z. With Hessians two more lumps
// follow: xx, xy, xz, yy and yz, zz, 0, 0.
template <typename T>  // std::int32_t or double
struct alignas(4 * sizeof(T)) VertexLump {
  T value[4];
};
// Returns the number of VertexLumps of a vertex.
constexpr std::size_t lumps_per_vertex(bool hessians) { return hessians ? 3 : 1; }

struct BlockParameters {
  Vec3 center;                        // in the mesh's coordinates
  double scale = 1;                   // a power of two that brings lengths to about 1
  double degree = 0;                  // L
  double grazing2 = 0;                // square of the slope d_T / r below which a face is grazing
  double tolerance2 = 0;              // largest square of a face's error (in weight) that is lumped
  double mean_reach2 = 0;             // largest (edge / radius)^2 for which lumps serve for c_00
  double mean_nodes_reach2 = 0;       // largest (edge / radius)^2 for which six nodes serve
  double per_weight = 0;              // quanta per unit of weight
  double per_gradient = 0;            // quanta per unit of gradient
  double largest = 0;                 // largest weight, in quanta
  bool hessians = false;              // VGH if true, else VG
  double per_hessian = 0;             // with VGH: quanta per unit of Hessian
  HermiteEdgeReach edge_reach2 = {};  // with VGH: reaches of the rules
  HermiteFaceReach face_reach2 = {};
  // Half-edges with a name below this number are kept: both half-edges of one in 2^32 /
  // sampled_names of all edges.
  std::uint32_t sampled_names = 0;
  std::uint32_t largest_index = 0;  // largest index of the block, or more
};

enum TriangleFlag : std::uint8_t {
  kLumped = 0,
  kNodes = 1,     // needs nodes of its own: large, steep, grazing, or nearly degenerate
  kMeanNodes = 2  // needs nodes for c_00
};

// W z^4 of a half-edge. The error of an edge is the sum of its two half-edges, which nearly cancel
// on smooth surfaces.
struct SampledHalfEdge {
  std::uint64_t name = 0;  // name of the edge, from the coordinates of its ends
  double error = 0;
  bool lumped = false;
};

// Returns the place of the lump of face t in a block. Integers of eight faces come out of vectors
// with the even faces first.
template <typename T>
constexpr std::size_t lump_slot(std::size_t t) {
  return sizeof(T) == 4 ? t / 8 * 8 + t % 2 * 4 + t % 8 / 2 : t;
}

template <typename T>
struct TriangleBlock {
  static constexpr std::size_t kSize = kTrianglesPerBlock;
  alignas(64) std::uint32_t hash[3][kSize];
  alignas(64) double corner[3][3][kSize];  // [corner][x, y, z], relative to the centre, scaled
  // Errors of lumping, see lumping_error() in hermite_rules.h: W z^4 of the half-edges, F z^4, and
  // the sum of their squares.
  alignas(64) double edge_error[3][kSize];
  alignas(64) double face_error[kSize];
  alignas(64) double error2[kSize];
  alignas(64) double edge_weight[3][kSize];  // W
  alignas(64) double face_weight[kSize];     // F
  alignas(64) std::uint8_t flag[kSize];
  alignas(64) std::uint8_t sampled[3][kSize / 8];  // bits that mark half-edges of the sample
  alignas(64) VertexLump<T> lump[3][kSize];        // see lump_slot()
  // With Hessians: further lumps of the corners, and nodes between them. An edge has a rule and a
  // weight of each node; a face has a rule and weights at the centre and of the orbits.
  alignas(64) VertexLump<T> hessian[2][3][kSize];
  alignas(64) double edge_node[3][kSize];
  alignas(64) double center_node[kSize];
  alignas(64) double orbit_node[2][kSize];
  alignas(64) std::uint8_t edge_rule[3][kSize];
  alignas(64) std::uint8_t face_rule[kSize];
  bool has_nodes_between = false;
};

// Sums over blocks; lengths are scaled.
struct BlockSums {
  double volume6 = 0;      // sum of d2: six times the enclosed volume
  double mean = 0;         // sum of d2/2 <1/|x|^2> over faces without kMeanNodes: int r dOmega
  double face_error2 = 0;  // sum of (F z^4)^2 over lumped faces
  double min_d2 = 0;       // smallest d_T |d_T|
  double min_cos2 = 0;     // smallest cos gamma |cos gamma|
  double max_edge2 = 0;    // largest (edge / radius)^2
  double probe = 0;        // not a number if a coordinate is not finite
  std::size_t bad = 0;     // number of faces with d_T <= 0 beyond rounding
  std::size_t nodes = 0;   // number of faces with kNodes
  // Sums over half-edges of odd functions of the ends' coordinates. They are zero if each edge is
  // used equally often in both directions, and by chance about once in 2^60.
  std::uint32_t hash1 = 0, hash2 = 0;

  void add(const BlockSums& other);
};
BlockSums no_triangles();

// Reads n faces from `first` on and processes them. All indices must be valid: see
// largest_index().
template <typename T>
void work_block(const MeshView& mesh, std::size_t first, std::size_t n,
                const BlockParameters& parameters, TriangleBlock<T>& block, BlockSums& sums);

// Returns the largest vertex index of n faces from `first` on.
std::uint32_t largest_index(const MeshView& mesh, std::size_t first, std::size_t n);

}  // namespace rholm
