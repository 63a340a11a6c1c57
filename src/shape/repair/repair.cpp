// Repairs a mesh in steps that depend on each other. Duplicates are dropped before triangles are
// paired, and junctions are joined before borders have fans. Orientations agree before sheets are
// separated, fans are single before borders are followed, parts closed before cavities are found.
#include "rholm/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/check_fields.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "shape/coordinate_error.h"
#include "shape/face.h"
#include "shape/normal_attributes.h"
#include "shape/repair/hole_closing.h"
#include "shape/repair/junctions.h"
#include "shape/repair/outwards.h"
#include "shape/repair/sheets.h"
#include "shape/repair/thin_faces.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// Distance between copies of a vertex after they are moved apart, relative to the diagonal. Chosen:
// readers that weld keep the copies apart, but the gap is not visible.
constexpr double kApart = 1e-6;
// This distance relative to the largest coordinate: four spacings of floats, as most formats have.
constexpr double kApartSingle = 0x1p-21;

double largest_modulus(const Bounds& box) {
  double largest = 0;
  for (const Vec3& v : {box.min, box.max}) {
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  }
  return largest;
}

// A mesh under repair. Coordinates of `mesh_` are scaled by a power of two to be near 1.
class Repairer {
 public:
  Repairer(Mesh mesh, const RepairOptions& options, const Context& context)
      : options_(options), context_(context), given_(mesh.vertices), mesh_(std::move(mesh)) {
    const Bounds box = bounds(given_);
    scale_ = unit_frame(box).scale;
    single_ = is_in_single_precision(view_of(mesh_));
    error_ = scale_ * coordinate_error(view_of(mesh_));
    for (Vec3& v : mesh_.vertices) v *= scale_;
    ask_cancel();
    local_ = mesh_.vertices;
    diagonal_ = norm(scale_ * box.max - scale_ * box.min);
    largest_ = scale_ * largest_modulus(box);
  }

  void run() {
    const auto at = [&](double share) { report_progress(context_, "repair", share); };
    at(0);
    while (collapse_needles()) {
    }
    drop_duplicates();
    join();
    at(0.2);
    orient();
    separate();
    at(0.4);
    swap_thin();
    at(0.5);
    close();
    swap_thin();  // faces that close narrow holes are thin
    at(0.8);
    turn();
  }

  Repaired result() {
    report_.flipped_faces = static_cast<std::size_t>(std::count(turned_.begin(), turned_.end(), 1));
    turn_normals();
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const bool stayed = v < local_.size() && mesh_.vertices[v] == local_[v];
      mesh_.vertices[v] = stayed ? given_[v] : as_written(mesh_.vertices[v] / scale_);
    }
    return {weld(mesh_).mesh, report_};
  }

 private:
  // Rounds new vertices to the precision of the given ones, so that the error of all stays known.
  Vec3 as_written(const Vec3& v) const {
    if (!single_) return v;
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }

  // Returns true if two vertices may be one point within their rounding.
  bool may_coincide(std::uint32_t a, std::uint32_t b) const {
    const Vec3 apart = mesh_.vertices[a] - mesh_.vertices[b];
    return std::abs(apart.x) <= 2 * error_.x && std::abs(apart.y) <= 2 * error_.y &&
           std::abs(apart.z) <= 2 * error_.z;
  }

  // Collapses thin triangles with an edge that may be a point. Returns true if there were any.
  bool collapse_needles() {
    DisjointSets same(mesh_.vertices.size());
    bool found = false;
    CancelPoll poll;
    for (const Triangle& t : mesh_.faces) {
      poll();
      if (!is_thin(scaled_corners(mesh_, t, 1), error_)) continue;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (a == b || !may_coincide(a, b)) continue;
        same.unite(a, b);
        found = true;
      }
    }
    if (!found) return false;
    for (Triangle& t : mesh_.faces) {
      for (std::uint32_t& v : t) v = same.find(v);
    }
    report_.degenerate_faces += std::erase_if(mesh_.faces, has_repeated_corner);
    return true;
  }

  void drop_duplicates() {
    std::vector<std::pair<Triangle, std::uint32_t>> sorted;
    CancelPoll poll;
    for (std::uint32_t t = 0; t < mesh_.faces.size(); ++t) {
      poll();
      Triangle corners = mesh_.faces[t];
      std::sort(corners.begin(), corners.end());
      sorted.emplace_back(corners, t);
    }
    std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
      poll();
      return a < b;
    });
    std::vector<char> again(mesh_.faces.size(), 0);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      again[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
    }
    report_.duplicate_faces = drop(again);
  }

  void join() {
    const Junctions found = join_junctions(mesh_.vertices, error_, mesh_.faces);
    report_.degenerate_faces += found.thin;
    report_.junctions = found.joined;
  }

  std::size_t drop(const std::vector<char>& gone) {
    std::size_t kept = 0;
    const std::size_t n = mesh_.faces.size();
    for (std::size_t t = 0; t < n; ++t) {
      if (gone[t]) continue;
      if (!turned_.empty()) turned_[kept] = turned_[t];
      mesh_.faces[kept++] = mesh_.faces[t];
    }
    mesh_.faces.resize(kept);
    if (!turned_.empty()) turned_.resize(kept);
    return n - kept;
  }

  void find_all_mates() {
    mates_ = find_mates_at_all_edges(mesh_.vertices, mesh_.faces);
    parts_ = find_parts(mesh_.faces.size(), mates_);
  }

  // Orients across edges of two triangles first; edges of more triangles need the result.
  void orient() {
    mates_ = find_mates(mesh_.vertices.size(), mesh_.faces);
    parts_ = find_parts(mesh_.faces.size(), mates_);
    turned_ = orient_alike(mesh_.vertices, parts_, mesh_.faces, mates_).flipped;
    find_all_mates();
    const Orienting second = orient_alike(mesh_.vertices, parts_, mesh_.faces, mates_);
    for (std::size_t t = 0; t < turned_.size(); ++t) turned_[t] ^= second.flipped[t];
    one_sided_ = second.one_sided;
    report_.one_sided_parts =
        static_cast<std::size_t>(std::count(one_sided_.begin(), one_sided_.end(), 1));
  }

  void separate() {
    const std::vector<std::uint32_t> copies =
        separate_fans(mesh_.vertices.size(), mates_, mesh_.faces);
    if (copies.empty()) return;
    report_.split_vertices = copies.size();
    const std::size_t n = mesh_.vertices.size();
    std::vector<char> moves(n + copies.size(), 0);
    for (std::size_t i = 0; i < copies.size(); ++i) {
      mesh_.vertices.push_back(mesh_.vertices[copies[i]]);
      for (Attribute& a : mesh_.attributes) a.values.push_back(a.values[copies[i]]);
      moves[copies[i]] = moves[n + i] = 1;
    }
    move_into_sheets(moves);
  }

  // Moves vertices towards the mean of the other corners of their triangles.
  void move_into_sheets(const std::vector<char>& moves) {
    const double apart = std::max(kApart * diagonal_, kApartSingle * largest_);
    std::vector<Vec3> sums(moves.size());
    std::vector<double> counts(moves.size(), 0);
    for (const Triangle& t : mesh_.faces) {
      for (int k = 0; k < 3; ++k) {
        if (!moves[t[k]]) continue;
        sums[t[k]] += mesh_.vertices[t[(k + 1) % 3]] + mesh_.vertices[t[(k + 2) % 3]];
        counts[t[k]] += 2;
      }
    }
    for (std::size_t v = 0; v < moves.size(); ++v) {
      if (!moves[v]) continue;
      const Vec3 way = sums[v] / counts[v] - mesh_.vertices[v];
      mesh_.vertices[v] += std::min(0.5, apart / std::max(norm(way), 1e-300)) * way;
    }
  }

  void swap_thin() {
    std::vector<char> gone(mesh_.faces.size(), 0);
    const std::size_t removed = swap_thin_faces(mesh_.vertices, error_, mesh_.faces, mates_, &gone);
    if (removed == 0) return;
    report_.degenerate_faces += removed;
    drop(gone);
    find_all_mates();
    one_sided_.assign(parts_.n, 0);
    orient_again();
  }

  // Orients again after swaps, which keep the mates valid; parts may have new numbers.
  void orient_again() {
    Parts parts = parts_;
    const Orienting again = orient_alike(mesh_.vertices, parts, mesh_.faces, mates_);
    for (std::size_t t = 0; t < turned_.size(); ++t) turned_[t] ^= again.flipped[t];
    one_sided_ = again.one_sided;
  }

  void close() {
    close_holes(parts_, one_sided_, mates_, options_.max_hole, mesh_, report_);
    turned_.resize(mesh_.faces.size(), 0);
    find_all_mates();
  }

  void turn() {
    std::vector<char> wrong(mesh_.faces.size(), 0);
    turn_outwards(mesh_, parts_, mates_, wrong, report_, context_);
    flip_marked(wrong, mesh_.faces, mates_);
    for (std::size_t t = 0; t < wrong.size(); ++t) turned_[t] ^= wrong[t];
  }

  // Flips given normals at flipped triangles if they contradict these triangles.
  void turn_normals() {
    const NormalAttributes normals = normal_attributes(mesh_);
    if (!normals) return;
    const std::vector<Vec3> faces = area_normals(mesh_.vertices, mesh_.faces);
    std::vector<char> at_turned(mesh_.vertices.size(), 0);
    for (std::size_t t = 0; t < turned_.size(); ++t) {
      for (const std::uint32_t v : mesh_.faces[t]) at_turned[v] |= turned_[t];
    }
    for (std::size_t v = 0; v < at_turned.size(); ++v) {
      if (at_turned[v] && dot(normals[v], faces[v]) < 0) normals.set(v, -normals[v]);
    }
  }

  const RepairOptions& options_;
  const Context& context_;
  std::vector<Vec3> given_, local_;  // as given: unmoved vertices are returned exactly
  Mesh mesh_;
  double scale_ = 1, diagonal_ = 0, largest_ = 0;
  Vec3 error_;           // coordinate_error(), scaled
  bool single_ = false;  // true if all given coordinates are single-precision numbers
  std::vector<std::uint32_t> mates_;
  Parts parts_;
  std::vector<char> one_sided_;  // per part
  std::vector<char> turned_;     // for each triangle: flipped against the given mesh
  RepairReport report_;
};

}  // namespace

Repaired repair(const Mesh& mesh, const RepairOptions& options, const Context& context) {
  check_fields(options);
  const Welded exact = weld(mesh);
  const Welded welded = options.weld > 0 ? weld(mesh, options.weld) : exact;
  ask_cancel();
  Repairer repairer(welded.mesh, options, context);
  repairer.run();
  Repaired result = repairer.result();
  RepairReport& report = result.report;
  report.before = inspect(exact.mesh);
  report.merged_vertices = welded.merged_vertices;
  report.collapsed_faces = welded.collapsed_faces;
  report.isolated_vertices =
      mesh.vertices.size() - exact.merged_vertices - exact.mesh.vertices.size();
  report.after = inspect(result.mesh);
  if (report.after.boundary_edges > 0) report.closes_at = closing_tolerance(result.mesh);
  return result;
}

}  // namespace rholm
