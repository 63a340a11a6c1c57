#include "transform/methods/sources.h"

#include <algorithm>
#include <cmath>

#include "rholm/error.h"
#include "transform/rules/triangle_pieces.h"

namespace rholm {
namespace {

constexpr std::size_t kBlock = 1 << 16;  // chosen: 2 MiB of sources at a time

// A piece whose half-length exceeds this many times its distance is halved before a rule is tried.
// At larger ratios the ellipses of the bound are so thin that halving is cheaper. At ratio 1 a
// digit costs 2.6 degrees of exactness, at ratio 4 it costs 9.3.
constexpr double kLongest = 1.0;

// Largest number of halvings: after 100, a piece is 2^-100 of the first, far below the resolution
// of doubles.
constexpr int kMaxDepth = 100;

[[noreturn]] void throw_on_surface() {
  throw Error(ErrorCode::kInvalidInput,
              "the surface passes through the centre of the expansion: choose a centre inside it");
}

void visit_piece(const Vec3& a, const Vec3& b, double weight, int depth, const Allowance& allowance,
                 const SegmentDistance& distance,
                 const std::function<void(const Vec3&, double)>& visit) {
  const double half = norm(b - a) / 2;
  const double away = distance(a, b);
  const int exactness = half <= kLongest * away ? exactness_for(allowance, half, away) : 0;
  if (exactness == 0) {
    if (depth == kMaxDepth) throw_on_surface();
    const Vec3 middle = 0.5 * (a + b);
    visit_piece(a, middle, weight / 2, depth + 1, allowance, distance, visit);
    visit_piece(middle, b, weight / 2, depth + 1, allowance, distance, visit);
    return;
  }
  const GaussRule& rule = segment_rule(exactness);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    visit(a + rule.nodes[i] * (b - a), weight * rule.weights[i]);
  }
}

void visit_piece(const std::array<Vec3, 3>& p, double weight, int depth, const Allowance& allowance,
                 const std::function<void(const Vec3&, double)>& visit) {
  const std::size_t longest = longest_side(p);
  const double half = norm(p[(longest + 1) % 3] - p[longest]) / 2;
  const double away = triangle_distance(p);
  const int exactness = half <= kLongest * away ? exactness_for(allowance, half, away) : 0;
  if (exactness == 0) {
    if (depth == kMaxDepth) throw_on_surface();
    cut_triangle(p, 2 * kLongest, [&](const std::array<Vec3, 3>& piece, double share) {
      visit_piece(piece, weight * share, depth + 1, allowance, visit);
    });
    return;
  }
  visit_triangle_rule(exactness, [&](double a, double b, double c, double share) {
    visit(a * p[0] + b * p[1] + c * p[2], weight * share);
  });
}

}  // namespace

Sources::Sources(const AdjointNeeds& needs, const Context& context)
    : sum_(needs), context_(context) {
  directions_.reserve(kBlock);
  weights_.reserve(kBlock);
}

void Sources::add(const Vec3& x, double w) {
  directions_.push_back(x / norm(x));
  weights_.push_back(w);
  ++count_;
  if (directions_.size() == kBlock) flush();
}

void Sources::flush() {
  Context block = context_;
  if (context_.progress) {
    block.progress = [this](std::string_view stage, double fraction) {
      return context_.progress(stage, reported_ + fraction * (part_ - reported_));
    };
  }
  sum_.add(directions_, weights_, block);
  reported_ = part_;
  directions_.clear();
  weights_.clear();
}

Coefficients Sources::finish() {
  part_ = 1;
  flush();
  return sum_.finish(context_);
}

void visit_segment(const Vec3& a, const Vec3& b, const Allowance& allowance,
                   const SegmentDistance& distance,
                   const std::function<void(const Vec3&, double)>& visit) {
  visit_piece(a, b, 1, 0, allowance, distance, visit);
}

void visit_triangle(const std::array<Vec3, 3>& corners, const Allowance& allowance,
                    const std::function<void(const Vec3&, double)>& visit) {
  visit_piece(corners, 1, 0, allowance, visit);
}

}  // namespace rholm
