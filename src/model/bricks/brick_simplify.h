// Fewer triangles for the surface of all bricks. Layer: model, private.
//
// Each brick is simplified with the vertices that it shares with others locked, as far as all
// bricks are for the same cost of a vertex; then the strips along the faces between bricks, which
// are gathered of as many bricks at a time as make one group, and of groups of groups. What
// vertices stand for already (their quadrics) goes from each step to the next, so that errors are
// those against the given surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_gather.h"
#include "model/bricks/brick_parts.h"
#include "model/bricks/brick_surface.h"
#include "rholm/context.h"
#include "rholm/simplify.h"
#include "shape/simplify/simplify_part.h"

namespace rholm {

struct BrickSimplifyOptions {
  SimplifyOptions stops = {};   // at least one
  std::uint64_t triangles = 0;  // of the whole, given
  double step = 1;              // of the grid
  std::size_t group = 64;       // bricks whose strips are in memory at a time
};

class BrickSimplify {
 public:
  // `parts` says what of the surface stays, and outlives this.
  BrickSimplify(PieceStore& store, BrickSurface& surface, const BrickParts& parts,
                std::size_t n_bricks, const BrickSimplifyOptions& options);

  // How the cost grows with each triangle less: "curve/BRICK". Only if wants_curves().
  bool wants_curves() const { return n_bricks_ > 1 && most_ > 0; }
  void find_curve(std::size_t brick, const Context& context);
  bool has_curve(std::size_t brick) const;
  // Once all are there.
  void choose();

  // Level 0 is each brick by itself, the others are strips between groups. Of each level: begin(),
  // work() on all groups that has() does not know, in any order, end() by one process, and take().
  std::size_t n_levels() const;
  void begin(std::size_t level);
  std::size_t n_groups() const;
  bool has(std::size_t group) const;
  void work(std::size_t group, const Context& context);
  void end();
  void take();
  // As Simplification::error, once all is done.
  double error() const;

 private:
  using Name = BrickSurface::VertexOfBrick;
  using Planes = std::vector<std::pair<Name, PlaneQuadric>>;  // by names

  SimplifyPart whole_part(std::size_t brick, const BrickMesh& mesh) const;
  // Vertices that bricks of different groups have, of so many bricks each.
  void find_shared(std::size_t group);
  bool is_shared(const Name& name) const;
  std::vector<std::uint8_t> near_shared(std::size_t brick, const BrickMesh& mesh) const;
  void simplify(std::size_t brick, const Context& context);
  void join(std::size_t group, const Context& context);
  std::size_t group_of(std::size_t level) const;  // bricks
  Planes read_planes(std::size_t level, std::size_t first, std::size_t end) const;
  void write_planes(std::size_t level, std::size_t number, const Planes& planes,
                    double error) const;
  std::uint64_t count_triangles() const;

  PieceStore& store_;
  BrickSurface& surface_;
  const BrickParts& parts_;
  std::size_t n_bricks_;
  BrickSimplifyOptions options_;
  std::uint64_t most_ = 0;                   // triangles wanted, 0: the error decides
  std::vector<Name> shared_ = {};            // ascending
  std::vector<std::uint64_t> targets_ = {};  // of each brick
  std::size_t level_ = 0;                    // that is worked on
  std::string round_ = {};                   // of its meshes
  std::uint64_t to_go_ = 0;                  // triangles that are too many when it begins
  bool is_done_ = false;                     // by a run before
};

}  // namespace rholm
