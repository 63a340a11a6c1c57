// What a mesh pass decides before it starts, from a sample of the triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rholm/mesh_view.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/rules/plane_wave_rules.h"

namespace rholm {

// Triangles spread over the mesh, in runs of neighbours in the file's order; scaled lengths.
struct MeshSample {
  // In units of lumping_error(L): see TriangleBlock.
  struct Entry {
    double error2;        // of the triangle by itself: what the pass decides by
    double face_error2;   // (F z^4)^2
    double face_weight2;  // F^2
  };
  // An edge whose triangles both are in the sample: error2 of the triangles, the lower first, and
  // W z^4 of the half-edges in the same order; W of both together.
  struct Edge {
    double lower2, upper2;
    double lower, upper;
    double weight;
  };
  std::vector<Entry> entries;  // error2 ascending
  std::vector<Edge> edges;
  // What rules with Hessians need to know of a triangle: W and z^2 of the half-edges, see
  // kHermiteBend, and F; and the half-edges 3 t + i that are of one edge.
  struct Triangle {
    std::array<double, 3> weight, z2;
    double face;
  };
  std::vector<Triangle> triangles;
  std::vector<std::array<std::uint32_t, 2>> twins;
  double edge_share = 0;  // edges of the mesh per edge of the sample; 0: none is known
  // Where no edge is known: energy of the edges' errors in units of the faces'. As on smooth
  // meshes, until a pass has measured it.
  double edge_ratio = 3;
  // The same as a pass has found it, at least: edges between parts of the file that are not in the
  // sample together may be creases. 0: there was none.
  double measured_ratio = 0;
  double scale = 1;       // a power of two that brings lengths to about 1
  double mean = 0;        // of r over directions
  double norm = 0;        // sqrt(int (r - mean)^2 dOmega)
  double share = 1;       // triangles of the mesh per triangle of the sample
  bool overlaps = false;  // some faces turn their back
  double angle = 0;       // of an edge as seen from the centre, on average
  double aligned = 0;     // share of the edges, by weight, along meridians or parallels
};
MeshSample sample_mesh(const MeshView& mesh, const Vec3& center, int degree);

struct MeshPlan {
  BlockParameters block;
  NodeAllowance divided, undivided;
  double rules = 0;    // error the rules may leave, l2, scaled length
  double caution = 1;  // what the rules' errors may exceed the model by
  double in_step = 1;  // see neighbours_in_step(), of lumped triangles
  double window = 0;   // and the windows of the transform
  double quanta = 0;   // and what rounding of lumps to quanta leaves
  // Their error in any case: a mesh whose vertices lie in lattice lines may be in step with the
  // grid, then the error is of the size of the low degrees themselves, not of random sums.
  double most_window = 0;
  double node_share = 0;  // part of the triangles that get nodes, as the sample has it
  double between = 0;     // nodes between the vertices of lumped triangles, per triangle, likewise
  double source2 = 0;     // sum of squares of the nodes' weights, as the sample has it
  double hessian2 = 0;    // and of L^2 times Hessians
  bool single = false;    // single precision will do
  double mean_error = 0;  // relative, of c_00
  // Energy of the whole error of lumping in units of that of the faces on their own, if all is
  // lumped because neighbours cancel; 0 where triangles are judged on their own.
  double coherence = 0;
  double rounding = 0;  // what double precision leaves at best, in the mesh's unit
};
// What a first try has taught.
struct PlanLimits {
  double tighten = 1;  // divides what is allowed
  bool forbid_single = false;
  bool many_nodes = false;  // more than the sample said
};
MeshPlan plan_mesh(const MeshView& mesh, const MeshSample& sample, const Vec3& center, int degree,
                   double precision, const PlanLimits& limits);

// Sum of squares of W z^4 over all edges between lumped triangles, from the sample of half-edges
// the pass took. Sorts it.
double sampled_error2(std::vector<SampledHalfEdge>& sample, std::uint32_t sampled_names);

// l2 error of the rules, scaled length, for a sum of squares over lumped triangles in units of
// lumping_error(L)^2 and a number of triangles with nodes.
double rule_error(const MeshPlan& plan, double lumped2, double noded);

// The window error that keeps the plan's share for sources whose squared weights have that sum.
double window_error(const MeshPlan& plan, double source2);

}  // namespace rholm
