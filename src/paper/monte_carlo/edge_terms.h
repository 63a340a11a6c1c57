// Points on the edges and the paper's field there, made right: the terms of (M1) for all orders.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "rholm/vec3.h"
#include "transform/geometry/star_geometry.h"

namespace rholm {

// A face as the field sees it. A face that contains the pole is cut there into three.
struct FieldFace {
  Vec3 n;                         // turned so that d >= 0
  double d = 0;                   // 0: seen edge on or without area, takes no part
  double slant = 0;               // hypot(n_x, n_y)
  double phi_n = 0;               // atan2(n_y, n_x)
  std::complex<double> turn = 1;  // e^{-i phi_n}
  double phi_middle = 0;          // of its range of longitudes,
  double phi_half = 0;            // phi_middle +- phi_half, phi_half <= pi/2
  double largest_radius = 0;
};

// An edge (or a cut from the pole) between two faces; -1: no face.
struct FieldEdge {
  Vec3 a, along;   // points a + t along, 0 <= t <= 1
  int left = -1;   // has it in this sense
  int right = -1;  // has it in the other
};

struct FieldEdges {
  std::vector<FieldFace> faces;
  std::vector<FieldEdge> edges;
};

FieldEdges field_edges(const StarGeometry& geometry);

// Where the integral of (M2) starts. The field may have any function of theta added (Stokes: only
// d/dphi matters): that changes no mean, but it does change the scatter.
enum class FieldStart {
  kNormal,  // at phi_n, as in (M2)
  kFace     // within the face's own longitudes: the least scatter, see edge_terms.cpp
};

// Room to work in, one for each thread.
struct FieldScratch {
  std::vector<std::complex<double>> k, value;
  std::vector<double> upper;
};

// The integrand of (M1) at a point: sum over faces and edges of int_0^1 Pt_lm re[m] dt is C_lm, of
// Pt_lm im[m] S_lm. Returns the direction.
Vec3 field_at(const FieldEdges& field, const FieldEdge& edge, double t, FieldStart start,
              std::span<std::complex<double>> terms, FieldScratch& scratch);

}  // namespace rholm
