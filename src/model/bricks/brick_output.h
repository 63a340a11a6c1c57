// The surface of all bricks, with what their points tell of it, as a file. Layer: model, private.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_parts.h"
#include "model/bricks/brick_scene.h"
#include "model/bricks/brick_stages.h"
#include "model/bricks/point_rows.h"
#include "model/points/surface_confidence.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"

namespace rholm {

class BrickOutput {
 public:
  using Load = std::function<BrickScene(std::size_t brick)>;  // a brick's points and its halo

  BrickOutput(PieceStore& store, BrickStages& stages, const ReconstructOptions& options,
              const PointLayout& layout, std::size_t n_bricks, Load load)
      : store_(store),
        stages_(stages),
        options_(options),
        layout_(layout),
        n_bricks_(n_bricks),
        load_(std::move(load)) {}

  // As add_confidence() measures them, of all triangles.
  ConfidenceAreas measure_confidence(const BrickParts& parts) const;
  // In place, by all of the crew; one part after the other where the output is no regular file.
  void write(const BrickParts& parts, const BrickParts::Whole& whole,
             const std::filesystem::path& output) const;
  // In memory, with the values that write() would round to the file's. Throws Unsupported for more
  // vertices than a Mesh can number.
  Mesh collect(const BrickParts& parts, const BrickParts::Whole& whole) const;
  std::vector<Attribute> attributes() const;  // names and types of those of the surface

 private:
  bool is_left_out(const std::string& attribute) const;
  void carry(std::size_t brick, Mesh& vertices) const;

  PieceStore& store_;
  BrickStages& stages_;
  const ReconstructOptions& options_;
  const PointLayout& layout_;
  std::size_t n_bricks_;
  Load load_;
};

}  // namespace rholm
