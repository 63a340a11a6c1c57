// The terms of (M1) for all orders, from the corrected field of the paper at points on edges.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "rholm/vec3.h"
#include "transform/geometry/star_geometry.h"

namespace rholm {

// A face with its data for the field. A face that contains the pole is split there into three.
struct FieldFace {
  Vec3 n;                         // turned so that d >= 0
  double d = 0;                   // 0: seen edge on or without area, not used
  double slant = 0;               // hypot(n_x, n_y)
  double phi_n = 0;               // atan2(n_y, n_x)
  std::complex<double> turn = 1;  // e^{-i phi_n}
  double phi_middle = 0;          // middle of its range of longitudes
  double phi_half = 0;            // half of the range, at most pi/2
  double largest_radius = 0;
};

// An edge (or a cut from the pole) between two faces; -1: no face.
struct FieldEdge {
  Vec3 a, along;   // points a + t along, 0 <= t <= 1
  int left = -1;   // face with the edge in this direction
  int right = -1;  // face with the edge reversed
};

struct FieldEdges {
  std::vector<FieldFace> faces;
  std::vector<FieldEdge> edges;
};

FieldEdges field_edges(const StarGeometry& geometry);

// Start of the integral of (M2). Adding any function of theta to the field (Stokes: only d/dphi
// matters) changes no mean, but it changes the scatter.
enum class FieldStart {
  kNormal,  // at phi_n, as in (M2)
  kFace     // within the face's longitudes: least scatter, see edge_terms.cpp
};

// Work arrays, one object for each thread.
struct FieldScratch {
  std::vector<std::complex<double>> k, value;
  std::vector<double> upper;
};

// Computes the integrand of (M1) at a point. The sum over faces and edges of int_0^1 Pt_lm re[m] dt
// is C_lm; the sum with im[m] is S_lm. Returns the direction.
Vec3 field_at(const FieldEdges& field, const FieldEdge& edge, double t, FieldStart start,
              std::span<std::complex<double>> terms, FieldScratch& scratch);

}  // namespace rholm
