#include "surface/star/mesh_portions.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/ranked_set.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // rows read before they are released: 24 MB

// Chosen: about 11 MB with the tree; neighbouring scouts are 1/256 of the mesh's size apart.
constexpr std::size_t kMostScouts = std::size_t{1} << 16;

// Tracks rows that are read in order, and releases them in blocks.
class RowsUsed {
 public:
  using Release = std::function<void(std::size_t first, std::size_t n)>;
  explicit RowsUsed(const Release& release) : release_(release) {}
  void add(std::size_t row) {
    if (!some_) first_ = last_ = row;
    some_ = true;
    jumps_ += row - last_ > kRowsOfPage;
    last_ = row;
    if (jumps_ == kMostJumps || last_ - first_ >= kBlock) finish();
  }
  void finish() {
    if (some_ && release_) release_(first_, last_ - first_ + 1);
    some_ = false;
    jumps_ = 0;
  }

 private:
  static constexpr std::size_t kRowsOfPage = 128;  // rows per page, at least
  // Chosen: about 64 MB, with the pages that the system loads around each page.
  static constexpr std::size_t kMostJumps = 1024;
  const Release& release_;
  std::size_t first_ = 0, last_ = 0, jumps_ = 0;
  bool some_ = false;
};

VertexRange range_of_vertices(const MeshInPlace& mesh, const Context& context) {
  VertexRange all;
  for (std::size_t first = 0; first < mesh.mesh.n_vertices; first += kBlock) {
    MeshView block = mesh.mesh;
    block.vertices += first * block.vertex_stride;
    block.n_vertices = std::min(kBlock, mesh.mesh.n_vertices - first);
    const VertexRange range = vertex_range(block, context);
    for (std::size_t k = 0; k < 3; ++k) all.add(k, range.min[k], range.max[k]);
    all.finite = all.finite && range.finite;
    if (mesh.release_vertices) mesh.release_vertices(first, block.n_vertices);
  }
  return all;
}

std::uint32_t largest_index(const MeshInPlace& mesh) {
  std::uint32_t largest = 0;
  for (std::size_t first = 0; first < mesh.mesh.n_faces; first += kBlock) {
    ask_cancel();
    const std::size_t n = std::min(kBlock, mesh.mesh.n_faces - first);
    for (std::size_t t = first; t < first + n; ++t) {
      const Triangle corners = mesh.mesh.triangle(t);
      largest = std::max({largest, corners[0], corners[1], corners[2]});
    }
    if (mesh.release_faces) mesh.release_faces(first, n);
  }
  return largest;
}

}  // namespace

Bounds checked_bounds(const MeshInPlace& mesh, const Context& context) {
  const VertexRange range = range_of_vertices(mesh, context);
  const bool in_range = mesh.mesh.n_faces == 0 || largest_index(mesh) < mesh.mesh.n_vertices;
  if (!range.finite || !in_range) validate(mesh.mesh);  // throws and names the wrong element
  if (mesh.mesh.n_vertices == 0) return {};
  return {.min = {range.min[0], range.min[1], range.min[2]},
          .max = {range.max[0], range.max[1], range.max[2]}};
}

MeshPortions::MeshPortions(const MeshInPlace& mesh, double scale, std::size_t triangles)
    : mesh_(mesh), scale_(scale), triangles_(std::max<std::size_t>(1, triangles)) {}

MeshPortion MeshPortions::load(std::size_t p) const {
  const std::size_t first = p * triangles_;
  return gather({.first = first}, std::min(triangles_, n_faces() - first));
}

MeshPortion MeshPortions::scouts() const {
  const std::size_t most = std::min(triangles_, kMostScouts);
  const std::size_t step = (n_faces() + most - 1) / most;
  return gather({.first = 0, .step = step}, (n_faces() + step - 1) / step);
}

MeshPortion MeshPortions::gather(const PortionNumbers& numbers, std::size_t n) const {
  MeshPortion portion{.mesh = {}, .numbers = numbers};
  CancelPoll poll;
  std::vector<Triangle>& triangles = portion.mesh.faces;
  triangles.reserve(n);
  std::uint32_t low = UINT32_MAX, high = 0;
  RowsUsed used_triangles(mesh_.release_faces);
  for (std::size_t k = 0; k < n; ++k) {
    poll();
    const std::size_t number = numbers.first + k * numbers.step;
    const Triangle t = mesh_.mesh.triangle(number);
    low = std::min({low, t[0], t[1], t[2]});
    high = std::max({high, t[0], t[1], t[2]});
    triangles.push_back(t);
    used_triangles.add(number);
  }
  used_triangles.finish();
  if (n == 0) return portion;
  RankedSet set(low, std::size_t{high} - low + 1);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t corner : t) set.add(corner);
  }
  const std::vector<std::uint32_t> names = set.sorted();
  portion.mesh.vertices.reserve(names.size());
  RowsUsed used_vertices(mesh_.release_vertices);
  for (const std::uint32_t name : names) {
    poll();
    portion.mesh.vertices.push_back(scale_ * mesh_.mesh.vertex(name));
    used_vertices.add(name);
  }
  used_vertices.finish();
  for (Triangle& t : triangles) {
    poll();
    for (std::uint32_t& corner : t) corner = set.rank(corner);
  }
  return portion;
}

}  // namespace rholm
