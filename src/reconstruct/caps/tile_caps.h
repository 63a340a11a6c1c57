// The caps of all tiles, put aside tile by tile, and read where they reach. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "parts/store.h"
#include "rholm/atlas.h"
#include "rholm/context.h"
#include "rholm/topology.h"
#include "surface/field/cap_field.h"

namespace rholm {

// Where some caps are, and how far they reach.
struct CapExtent {
  std::uint64_t n = 0, coefficients = 0;
  Bounds middles = {};   // of the middles of their supports
  double half_axis = 0;  // the longest of their supports
  double support = 0;    // the largest of their frames
  double deviation = 0;  // the largest from their tangent planes

  // All places where they have a weight, with bands of at least that.
  Bounds reach(double least_band) const;
};

// A cap as a patch of the surface.
struct CapPatch {
  Vec3 point, normal;  // as CapFoot
  double support = 0;  // of its frame
  double area = 0;     // that it was made for
  double error = 0;    // Cap::error
};

// Some caps in the order of their tiles, with the band of each.
struct NearCaps {
  Atlas atlas;
  CapBands bands;
  std::vector<Disc> discs;
};

class TileCaps {
 public:
  // `round` is in the names of its pieces: caps that are fitted once more are others.
  TileCaps(PieceStore& store, std::size_t n_tiles, std::string round = "")
      : store_(store), indices_(n_tiles), round_(std::move(round)) {}

  // Puts the caps of a tile aside: "caps/TILE", and what they are as patches: "patches/TILE".
  void write(std::size_t tile, Cover&& found, const Context& context);
  bool has(std::size_t tile) const;
  // Points that no cap fits, by their places in the tile, ascending: "rejected/TILE", before the
  // caps are written.
  void write_rejected(std::size_t tile, const std::vector<std::uint32_t>& places);
  std::vector<std::uint32_t> rejected(std::size_t tile) const;
  // Once all are there, and before anything below is asked for.
  void read_extents();
  const CapExtent& extent(std::size_t tile) const { return indices_[tile].whole; }
  std::vector<CapPatch> patches(std::size_t tile) const;

  // What all have in common: blend, noise and so on, without caps; and the edge of the grid.
  void set_scene(const Atlas& scene, double step) { scene_ = scene, step_ = step; }
  const Atlas& scene() const { return scene_; }
  double step() const { return step_; }
  double least_band() const { return band_of(scene_, step_); }

  // Whether some caps have wider bands than others: then find_bands() must be called for all tiles
  // before near() is asked.
  bool have_bands() const;
  void find_bands(std::size_t tile, const Context& context);
  bool has_bands(std::size_t tile) const;

  // All caps of all tiles, in their order.
  Atlas all() const;
  // Removes the caps from the store, unless the store is kept.
  void forget();
  // All caps that reach some boxes, in the order of the tiles.
  NearCaps near(std::span<const Bounds> boxes) const;

 private:
  struct Index {
    CapExtent whole;
    std::vector<CapExtent> chunks;
  };
  // Adds caps of a tile, and their bands, if some have their own: those that reach a box, or all
  // that are read together with one.
  enum class Which { kEach, kChunks };
  void append(std::size_t tile, std::span<const Bounds> boxes, Which which, Atlas& atlas,
              std::vector<double>* bands) const;

  std::string name_of(const char* what, std::size_t tile) const;

  PieceStore& store_;
  std::vector<Index> indices_;
  std::string round_;
  Atlas scene_;
  double step_ = 0;
};

// Boxes.
Bounds grown(const Bounds& box, double by);
bool meet(const Bounds& a, const Bounds& b);
Bounds joined(const Bounds& a, const Bounds& b);

}  // namespace rholm
