// The surface of all tiles, with what their points tell of it, as a file. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "parts/stages.h"
#include "parts/store.h"
#include "reconstruct/output/surface_confidence.h"
#include "reconstruct/points/point_rows.h"
#include "reconstruct/points/tile_scene.h"
#include "reconstruct/surface/tile_parts.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"

namespace rholm {

class TileOutput {
 public:
  // A tile's points and its halo.
  using Load = std::function<std::shared_ptr<const TileScene>(std::size_t tile)>;

  TileOutput(PieceStore& store, Stages& stages, const ReconstructOptions& options,
             const PointLayout& layout, std::size_t n_tiles, Load load)
      : store_(store),
        stages_(stages),
        options_(options),
        layout_(layout),
        n_tiles_(n_tiles),
        load_(std::move(load)) {}

  // As add_confidence() measures them, of all triangles.
  ConfidenceAreas measure_confidence(const TileParts& parts) const;
  // In place, by all processes; one part after the other where the output is no regular file.
  void write(const TileParts& parts, const TileParts::Whole& whole,
             const std::filesystem::path& output) const;
  // In memory, with the values that write() would round to the file's. Throws Unsupported for more
  // vertices than a Mesh can number.
  Mesh collect(const TileParts& parts, const TileParts::Whole& whole) const;
  std::vector<Attribute> attributes() const;  // names and types of those of the surface
  // Carries attributes of the points of a tile to vertices there. Returns the areas of
  // add_confidence().
  ConfidenceAreas carry(std::size_t tile, Mesh& vertices) const;

 private:
  bool is_left_out(const std::string& attribute) const;

  PieceStore& store_;
  Stages& stages_;
  const ReconstructOptions& options_;
  const PointLayout& layout_;
  std::size_t n_tiles_;
  Load load_;
};

}  // namespace rholm
