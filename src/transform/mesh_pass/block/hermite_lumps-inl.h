// Lumps faces at their corners, by Hermite's rules with gradients (VG) or Hessians as well (VGH,
// hermite_rules.h), in whole quanta. Inner loops of block.cpp, compiled for each target.
#include <array>
#include <cstddef>
#include <cstdint>

#include "transform/mesh_pass/block/block.h"

#if defined(RHOLM_TRANSFORM_HERMITE_LUMPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_TRANSFORM_HERMITE_LUMPS_INL_H_
#undef RHOLM_TRANSFORM_HERMITE_LUMPS_INL_H_
#else
#define RHOLM_TRANSFORM_HERMITE_LUMPS_INL_H_
#endif

#include <hwy/highway.h>

#include "shape/queries/corner_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using M = hn::Mask<D>;
using V3 = Vector3;

// Weight and gradient of lanes, in quanta but not yet rounded.
struct Lump {
  V weight;
  V3 gradient;
};

// Weights and gradients of a face add up to zero, if need be together with its nodes. Rounded
// values must, too: in a lattice all faces have the same rounding, which would add up. So the third
// corner has the negative sum of the others.
template <bool kNodes>
HWY_INLINE void store_lumps(D d, const Lump& first, const Lump& second, V nodes, size_t at,
                            TriangleBlock<double>& b) {
  const auto store = [&](const Lump& l, VertexLump<double>* to) HWY_ATTR {
    hn::StoreInterleaved4(l.weight, l.gradient.x, l.gradient.y, l.gradient.z, d, to[at].value);
  };
  const auto whole = [&](const Lump& l) HWY_ATTR {
    return Lump{hn::Round(l.weight),
                {hn::Round(l.gradient.x), hn::Round(l.gradient.y), hn::Round(l.gradient.z)}};
  };
  const auto rest = [&](V one, V other) HWY_ATTR { return hn::Neg(hn::Add(one, other)); };
  const Lump f = whole(first), s = whole(second);
  store(f, b.lump[0]);
  store(s, b.lump[1]);
  const V weight = rest(f.weight, s.weight);
  store({kNodes ? hn::Sub(weight, nodes) : weight,
         {rest(f.gradient.x, s.gradient.x), rest(f.gradient.y, s.gradient.y),
          rest(f.gradient.z, s.gradient.z)}},
        b.lump[2]);
}

HWY_INLINE void store_four(D d, const Lump& l, size_t at, VertexLump<double>* to) {
  const auto whole = [&](V v) HWY_ATTR { return hn::Round(v); };
  hn::StoreInterleaved4(whole(l.weight), whole(l.gradient.x), whole(l.gradient.y),
                        whole(l.gradient.z), d, to[at].value);
}

#if HWY_TARGET == HWY_SCALAR
template <bool kNodes>
HWY_INLINE void store_lumps(D d, const Lump& first, const Lump& second, V nodes, size_t at,
                            TriangleBlock<int32_t>& b) {
  const V f[4] = {first.weight, first.gradient.x, first.gradient.y, first.gradient.z};
  const V s[4] = {second.weight, second.gradient.x, second.gradient.y, second.gradient.z};
  const size_t slot = lump_slot<int32_t>(at);
  const hn::Rebind<int32_t, D> di;
  for (int k = 0; k < 4; ++k) {
    const V a = hn::Round(f[k]), c = hn::Round(s[k]);
    hn::Store(hn::DemoteTo(di, a), di, b.lump[0][slot].value + k);
    hn::Store(hn::DemoteTo(di, c), di, b.lump[1][slot].value + k);
    const V extra = kNodes && k == 0 ? nodes : hn::Zero(d);
    hn::Store(hn::DemoteTo(di, hn::Neg(hn::Add(hn::Add(a, c), extra))), di,
              b.lump[2][slot].value + k);
  }
}
HWY_INLINE void store_four(D, const Lump& l, size_t at, VertexLump<int32_t>* to) {
  const V v[4] = {l.weight, l.gradient.x, l.gradient.y, l.gradient.z};
  const hn::Rebind<int32_t, D> di;
  for (int k = 0; k < 4; ++k) {
    hn::Store(hn::DemoteTo(di, hn::Round(v[k])), di, to[lump_slot<int32_t>(at)].value + k);
  }
}
#else
// Lumps of even and of odd faces, four numbers each.
struct PackedLump {
  hn::Vec<hn::Repartition<uint32_t, D> > even, odd;
};
// Adding 1.5 2^52 puts the nearest whole number, modulo 2^32, into the lower half of a double.
HWY_INLINE PackedLump packed(D d, const Lump& l) {
  const hn::Repartition<uint32_t, D> du;
  const hn::Repartition<uint64_t, D> d64;
  const auto whole = [&](V v)
                         HWY_ATTR { return hn::BitCast(d64, hn::Add(v, hn::Set(d, 0x1.8p52))); };
  const auto pair = [&](V low, V high) HWY_ATTR {
    return hn::BitCast(d64, hn::OddEven(hn::BitCast(du, hn::ShiftLeft<32>(whole(high))),
                                        hn::BitCast(du, whole(low))));
  };
  const auto wx = pair(l.weight, l.gradient.x), yz = pair(l.gradient.y, l.gradient.z);
  return {hn::BitCast(du, hn::InterleaveLower(d64, wx, yz)),
          hn::BitCast(du, hn::InterleaveUpper(d64, wx, yz))};
}
HWY_INLINE void store_packed(D, const PackedLump& l, size_t at, VertexLump<int32_t>* to) {
  const hn::Repartition<int32_t, D> di;
  hn::Store(hn::BitCast(di, l.even), di, to[lump_slot<int32_t>(at)].value);
  hn::Store(hn::BitCast(di, l.odd), di, to[lump_slot<int32_t>(at + 1)].value);
}
HWY_INLINE void store_four(D d, const Lump& l, size_t at, VertexLump<int32_t>* to) {
  store_packed(d, packed(d, l), at, to);
}
template <bool kNodes>
HWY_INLINE void store_lumps(D d, const Lump& first, const Lump& second, V nodes, size_t at,
                            TriangleBlock<int32_t>& b) {
  const hn::Repartition<uint32_t, D> du;
  const PackedLump f = packed(d, first), s = packed(d, second);
  const auto rest = [&](auto a, auto c) HWY_ATTR { return hn::Sub(hn::Zero(du), hn::Add(a, c)); };
  store_packed(d, f, at, b.lump[0]);
  store_packed(d, s, at, b.lump[1]);
  PackedLump third = {rest(f.even, s.even), rest(f.odd, s.odd)};
  if constexpr (kNodes) {
    const V zero = hn::Zero(d);
    const PackedLump more = packed(d, {nodes, {zero, zero, zero}});
    third = {hn::Sub(third.even, more.even), hn::Sub(third.odd, more.odd)};
  }
  store_packed(d, third, at, b.lump[2]);
}
#endif

// Values for the half-edges 0 -> 1, 1 -> 2, 2 -> 0 and for the face.
struct Weights {
  V e01, e12, e20, face;
};
HWY_INLINE void store_weights(D d, const Weights& w, double (*edges)[kTrianglesPerBlock],
                              double* faces, size_t at) {
  hn::Store(w.e01, d, edges[0] + at);
  hn::Store(w.e12, d, edges[1] + at);
  hn::Store(w.e20, d, edges[2] + at);
  hn::Store(w.face, d, faces + at);
}

// Returns the gradient of a corner; `out` and `in` are the gradients, per edge vector, of the edges
// that leave it and reach it.
HWY_INLINE V3 gradient_at(V out, const V3& e_out, V in, const V3& e_in) {
  return {hn::NegMulAdd(in, e_in.x, hn::Mul(out, e_out.x)),
          hn::NegMulAdd(in, e_in.y, hn::Mul(out, e_out.y)),
          hn::NegMulAdd(in, e_in.z, hn::Mul(out, e_out.z))};
}

// VG: lumps at the corners. `z2` are squares of the edges' extents. Returns the errors.
template <typename T>
HWY_INLINE Weights lump_gradients(D d, size_t at, const BlockParameters& parameters,
                                  const Weights& w, const Weights& z2, const V3& e01, const V3& e12,
                                  const V3& e20, TriangleBlock<T>& b) {
  const V half = hn::Set(d, 0.5 * parameters.per_weight);
  const V sixth = hn::Mul(hn::Neg(w.face), hn::Set(d, parameters.per_weight / 6));
  const V twelfth = hn::Set(d, parameters.per_gradient / 12);
  const V of_face = hn::Mul(w.face, hn::Set(d, parameters.per_gradient / 24));
  const V g01 = hn::MulAdd(w.e01, twelfth, of_face), g12 = hn::MulAdd(w.e12, twelfth, of_face);
  const V g20 = hn::MulAdd(w.e20, twelfth, of_face);
  // 1/2 (W of both edges at the corner) + F/3 = -F/6 - 1/2 (W of the other edge).
  const auto lump = [&](V opposite, V g_out, const V3& e_out, V g_in, const V3& e_in) HWY_ATTR {
    return Lump{hn::NegMulAdd(half, opposite, sixth), gradient_at(g_out, e_out, g_in, e_in)};
  };
  store_lumps<false>(d, lump(w.e12, g01, e01, g20, e20), lump(w.e20, g12, e12, g01, e01),
                     hn::Zero(d), at, b);
  const V z = hn::Max(z2.e01, hn::Max(z2.e12, z2.e20));
  const auto error = [&](V weight, V zz) HWY_ATTR { return hn::Mul(weight, hn::Mul(zz, zz)); };
  return {error(w.e01, z2.e01), error(w.e12, z2.e12), error(w.e20, z2.e20), error(w.face, z)};
}

// Chooses one of several numbers in each lane.
template <size_t kChoices>
struct Choice {
  M beyond[kChoices - 1];
  HWY_INLINE V of(const V (&numbers)[kChoices]) const {
    V chosen = numbers[0];
    for (size_t k = 1; k < kChoices; ++k) {
      chosen = hn::IfThenElse(beyond[k - 1], numbers[k], chosen);
    }
    return chosen;
  }
  // Returns number(k) in the lanes of rule k.
  template <typename Number>
  HWY_INLINE V rule(D d, const Number& number) const {
    V numbers[kChoices];
    for (size_t k = 0; k < kChoices; ++k) numbers[k] = hn::Set(d, static_cast<double>(number(k)));
    return of(numbers);
  }
};
template <size_t kLimits>
HWY_INLINE Choice<kLimits + 1> choose(D d, V z2, const std::array<double, kLimits>& reach2) {
  Choice<kLimits + 1> choice;
  for (size_t k = 0; k < kLimits; ++k) choice.beyond[k] = hn::Gt(z2, hn::Set(d, reach2[k]));
  return choice;
}
HWY_INLINE void store_bytes(D, V v, std::uint8_t* to) {
  const hn::Rebind<int32_t, D> di;
  const hn::Rebind<uint8_t, D> db;
  hn::StoreU(hn::DemoteTo(db, hn::DemoteTo(di, v)), db, to);
}

// Terms that an edge with its rule adds to each of its ends.
struct HermiteTerms {
  V value, gradient, hessian, error;
};
// Components xx, xy, xz, yy, yz, zz of e e^T.
struct Outer {
  V v[6];
};
HWY_INLINE Outer outer(const V3& e) {
  return {{hn::Mul(e.x, e.x), hn::Mul(e.x, e.y), hn::Mul(e.x, e.z), hn::Mul(e.y, e.y),
           hn::Mul(e.y, e.z), hn::Mul(e.z, e.z)}};
}

// Returns the terms of half-edge i. Adds its nodes, in whole quanta, to `nodes`.
template <typename T>
HWY_INLINE HermiteTerms edge_terms(D d, size_t at, const BlockParameters& p, int i, V w, V z2,
                                   TriangleBlock<T>& b, V& nodes) {
  const auto& rules = kHermiteEdges;
  const auto rule = choose(d, z2, p.edge_reach2);
  const V z6 = hn::Mul(z2, hn::Mul(z2, z2));
  const V more = rule.of({hn::Set(d, 1.0), z2, hn::Mul(z2, z2)});
  HermiteTerms t;
  const V unit = rule.rule(d, [](size_t k) { return kHermiteEdgeUnits[k]; });
  t.error = hn::Mul(w, hn::Mul(unit, hn::Mul(z6, more)));
  t.value = hn::Mul(w, rule.rule(d, [&](size_t k) { return rules[k].value; }));
  t.gradient = hn::Mul(w, rule.rule(d, [&](size_t k) { return rules[k].gradient; }));
  t.hessian = hn::Mul(w, rule.rule(d, [&](size_t k) { return rules[k].hessian; }));
  if (hn::AllFalse(d, rule.beyond[0])) return t;
  const V node = hn::Round(hn::Mul(hn::Mul(w, hn::Set(d, p.per_weight)),
                                   rule.rule(d, [&](size_t k) { return rules[k].node; })));
  const V count = rule.rule(d, [&](size_t k) { return rules[k].nodes; });
  nodes = hn::MulAdd(node, count, nodes);
  hn::Store(hn::Mul(node, hn::Set(d, 1 / p.per_weight)), d, b.edge_node[i] + at);
  store_bytes(d, count, b.edge_rule[i] + at);
  b.has_nodes_between = true;
  return t;
}

// VGH: does the same as lump_gradients(), with Hessians.
template <typename T>
HWY_INLINE Weights lump_hessians(D d, size_t at, const BlockParameters& p, const Weights& w,
                                 const Weights& z2, const V3& e01, const V3& e12, const V3& e20,
                                 TriangleBlock<T>& b) {
  V nodes = hn::Zero(d);
  const HermiteTerms t01 = edge_terms(d, at, p, 0, w.e01, z2.e01, b, nodes);
  const HermiteTerms t12 = edge_terms(d, at, p, 1, w.e12, z2.e12, b, nodes);
  const HermiteTerms t20 = edge_terms(d, at, p, 2, w.e20, z2.e20, b, nodes);
  const auto& faces = kHermiteFaces;
  const V z = hn::Max(z2.e01, hn::Max(z2.e12, z2.e20)), root = hn::Sqrt(z);
  const auto rule = choose(d, z, p.face_reach2);
  // The powers are z^5 ... z^9.
  const V z4 = hn::Mul(z, z), z5 = hn::Mul(z4, root);
  const V powers = rule.of({z5, hn::Mul(z4, z), hn::Mul(z5, z), hn::Mul(z4, z4), hn::Mul(z5, z4)});
  const V unit = rule.rule(d, [](size_t k) { return kHermiteFaceUnits[k]; });
  const V face_error = hn::Mul(hn::Mul(w.face, unit), powers);
  const V scale = hn::Set(d, p.per_weight);
  if (!hn::AllFalse(d, rule.beyond[0])) {
    const V scaled = hn::Mul(w.face, scale), unscale = hn::Set(d, 1 / p.per_weight);
    const auto store_nodes = [&](V part, V count, double* to) HWY_ATTR {
      const V node = hn::Round(hn::Mul(scaled, part));
      nodes = hn::MulAdd(count, node, nodes);
      hn::Store(hn::Mul(node, unscale), d, to + at);
    };
    store_nodes(rule.rule(d, [&](size_t k) { return faces[k].center; }), hn::Set(d, 1.0),
                b.center_node);
    for (size_t i = 0; i < 2; ++i) {
      store_nodes(rule.rule(d, [&](size_t k) { return faces[k].orbits[i].weight; }),
                  rule.rule(d, [&](size_t k) { return faces[k].orbits[i].nodes(); }),
                  b.orbit_node[i]);
    }
    store_bytes(d, rule.rule(d, [](size_t k) { return k; }), b.face_rule + at);
    b.has_nodes_between = true;
  }
  const V value = hn::Mul(w.face, rule.rule(d, [&](size_t k) { return faces[k].value; }));
  const V slope = hn::Mul(w.face, rule.rule(d, [&](size_t k) { return faces[k].gradient; }));
  const V per_gradient = hn::Set(d, p.per_gradient);
  const auto gradient = [&](const HermiteTerms& t)
                            HWY_ATTR { return hn::Mul(per_gradient, hn::Add(t.gradient, slope)); };
  const V g01 = gradient(t01), g12 = gradient(t12), g20 = gradient(t20);
  const auto lump = [&](const HermiteTerms& out, const HermiteTerms& in, V g_out, const V3& e_out,
                        V g_in, const V3& e_in) HWY_ATTR {
    return Lump{hn::Mul(scale, hn::Add(value, hn::Add(out.value, in.value))),
                gradient_at(g_out, e_out, g_in, e_in)};
  };
  store_lumps<true>(d, lump(t01, t20, g01, e01, g20, e20), lump(t12, t01, g12, e12, g01, e01),
                    nodes, at, b);
  // a b^T + b a^T = a a^T + b b^T - c c^T for c = a - b, the opposite edge.
  const V per_hessian = hn::Set(d, p.per_hessian);
  const V product = hn::Mul(hn::Mul(per_hessian, w.face),
                            rule.rule(d, [&](size_t k) { return faces[k].product; }));
  const V both = hn::MulAdd(hn::Mul(per_hessian, w.face),
                            rule.rule(d, [&](size_t k) { return faces[k].square; }), product);
  const V h01 = hn::MulAdd(per_hessian, t01.hessian, both);
  const V h12 = hn::MulAdd(per_hessian, t12.hessian, both);
  const V h20 = hn::MulAdd(per_hessian, t20.hessian, both);
  const Outer o01 = outer(e01), o12 = outer(e12), o20 = outer(e20);
  const auto store = [&](int corner, V h_out, const Outer& out, V h_in, const Outer& in,
                         const Outer& opposite) HWY_ATTR {
    const auto number = [&](int k) HWY_ATTR {
      return hn::NegMulAdd(product, opposite.v[k],
                           hn::MulAdd(h_out, out.v[k], hn::Mul(h_in, in.v[k])));
    };
    store_four(d, {number(0), {number(1), number(2), number(3)}}, at, b.hessian[0][corner]);
    store_four(d, {number(4), {number(5), hn::Zero(d), hn::Zero(d)}}, at, b.hessian[1][corner]);
  };
  store(0, h01, o01, h20, o20, o12);
  store(1, h12, o12, h01, o01, o20);
  store(2, h20, o20, h12, o12, o01);
  return {t01.error, t12.error, t20.error, face_error};
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif  // include guard, for each target
