// Stores the caps of all tiles, one tile at a time, and reads the caps that reach a box. Layer:
// reconstruct, private.
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

// Extent of a set of caps, and how far their weights reach.
struct CapExtent {
  std::uint64_t n = 0, coefficients = 0;
  Bounds middles = {};   // box of the middles of their supports
  double half_axis = 0;  // longest half axis of their supports
  double support = 0;    // largest support of their frames
  double deviation = 0;  // largest distance from their tangent planes

  // Returns the box of all places where the caps have a weight, for bands of at least `least_band`.
  Bounds reach(double least_band) const;
};

// A cap as a patch of the surface.
struct CapPatch {
  Vec3 point, normal;  // as CapFoot
  double support = 0;  // of its frame
  double area = 0;     // area of the surface that it was made for
  double error = 0;    // Cap::error
};

// A set of caps in the order of their tiles, with the band of each cap.
struct NearCaps {
  Atlas atlas;
  CapBands bands;
  std::vector<Disc> discs;
};

class TileCaps {
 public:
  // `round` is part of the names of the pieces, so that caps fitted a second time get their own.
  TileCaps(PieceStore& store, std::size_t n_tiles, std::string round = "")
      : store_(store), indices_(n_tiles), round_(std::move(round)) {}

  // Stores the caps of a tile in "caps/TILE", and their patches in "patches/TILE".
  void write(std::size_t tile, Cover&& found, const Context& context);
  bool has(std::size_t tile) const;
  // Stores the points that no cap fits in "rejected/TILE", before the caps are written. `places`
  // are their places in the tile, ascending.
  void write_rejected(std::size_t tile, const std::vector<std::uint32_t>& places);
  std::vector<std::uint32_t> rejected(std::size_t tile) const;
  // Must be called after the caps of all tiles are written, and before the functions below.
  void read_extents();
  const CapExtent& extent(std::size_t tile) const { return indices_[tile].whole; }
  std::vector<CapPatch> patches(std::size_t tile) const;

  // Sets what all caps have in common: an atlas without caps, and the edge of the grid's cubes.
  void set_scene(const Atlas& scene, double step) { scene_ = scene, step_ = step; }
  const Atlas& scene() const { return scene_; }
  double step() const { return step_; }
  double least_band() const { return band_of(scene_, step_); }

  // Returns true if some cap has a band wider than least_band(). Then find_bands() must be called
  // for all tiles before near().
  bool have_bands() const;
  void find_bands(std::size_t tile, const Context& context);
  bool has_bands(std::size_t tile) const;

  // Returns all caps of all tiles, in the order of the tiles.
  Atlas all() const;
  // Removes the caps from the store, unless the store is kept.
  void forget();
  // Returns all caps that reach one of the boxes, in the order of the tiles.
  NearCaps near(std::span<const Bounds> boxes) const;

 private:
  struct Index {
    CapExtent whole;
    std::vector<CapExtent> chunks;
  };
  // Adds the caps of a tile that reach a box, and their own bands if `bands` is given. kChunks adds
  // all caps of each chunk that reaches a box.
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
