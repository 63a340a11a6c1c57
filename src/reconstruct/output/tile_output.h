// Writes the surface of all tiles, with attributes from their points, to a file or a mesh. Layer:
// reconstruct, private.
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
  // Returns a tile's points and its halo.
  using Load = std::function<std::shared_ptr<const TileScene>(std::size_t tile)>;

  TileOutput(PieceStore& store, Stages& stages, const ReconstructOptions& options,
             const PointLayout& layout, std::size_t n_tiles, Load load)
      : store_(store),
        stages_(stages),
        options_(options),
        layout_(layout),
        n_tiles_(n_tiles),
        load_(std::move(load)) {}

  // Returns the areas of add_confidence() for all triangles.
  ConfidenceAreas measure_confidence(const TileParts& parts) const;
  // Writes in place, from all processes; tile after tile if the output is no regular file.
  void write(const TileParts& parts, const TileParts::Whole& whole,
             const std::filesystem::path& output) const;
  // Returns the mesh in memory, with the values rounded as in the file of write(). Throws
  // Unsupported for more vertices than a Mesh can number.
  Mesh collect(const TileParts& parts, const TileParts::Whole& whole) const;
  std::vector<Attribute> attributes() const;  // names and types, without values
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
