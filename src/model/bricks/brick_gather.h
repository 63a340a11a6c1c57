// A part of the surface of all bricks as one mesh, and given back changed. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "model/bricks/brick_surface.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

class GatheredPart {
 public:
  static constexpr std::uint32_t kNew = ~std::uint32_t{0};
  // One flag per triangle of a brick's mesh.
  using Choose = std::function<std::vector<std::uint8_t>(std::size_t brick, const BrickMesh& mesh)>;
  using ChooseBrick = std::function<bool(std::size_t brick)>;

  // The chosen triangles of bricks first ... end - 1.
  GatheredPart(BrickSurface& surface, std::size_t first, std::size_t end, const Choose& choose);
  // The chosen triangles of some bricks; there is no rim().
  GatheredPart(BrickSurface& surface, std::size_t n_bricks, const ChooseBrick& choose_brick,
               const Choose& choose);

  // With all attributes of bricks' meshes. Vertices by bricks and places there, triangles by
  // bricks.
  const Mesh& mesh() const { return mesh_; }
  // Per vertex, whether a triangle that is not gathered has it, or may have it.
  const std::vector<std::uint8_t>& rim() const { return rim_; }
  std::uint32_t brick_of_triangle(std::size_t t) const { return triangles_[t].brick; }
  // Which vertex of which brick.
  const BrickSurface::VertexOfBrick& name(std::size_t v) const { return names_[v]; }
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  // The gathered vertex of that name, or kNone.
  std::uint32_t find(const BrickSurface::VertexOfBrick& name) const;

  // What comes instead of the gathered triangles: a mesh, which of the gathered vertices each
  // vertex is, kNew for new ones, and the brick of each triangle. Those of the rim must be there as
  // long as others have them, and stay as they are.
  struct Changed {
    Mesh mesh;
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> bricks;
    bool new_are_filled = false;  // see BrickMesh::filled
  };
  // `drop`, if given, tells which of the triangles that are not gathered go: one flag per triangle
  // of the brick. Only bricks that change are written.
  void replace(const Changed& changed, const Choose& drop = {});

 private:
  struct TriangleOfBrick {
    std::uint32_t brick = 0, triangle = 0;
  };
  struct Corner {
    BrickSurface::VertexOfBrick name;
    std::uint32_t vertex = 0;  // of the changed mesh
  };
  struct NewTriangles;
  struct Left;

  void gather(const ChooseBrick& choose_brick, const Choose& choose, Left* left);
  // Of each brick, whether what was gathered of it is not as it was.
  std::vector<std::uint8_t> changed_bricks(const Changed& changed) const;
  void find_rim(const std::vector<std::vector<bool>>& left_own,
                const std::vector<BrickSurface::VertexOfBrick>& left_foreign);
  std::uint32_t index_of(const BrickSurface::VertexOfBrick& name) const;
  void rewrite(std::size_t brick, const Changed& changed, const NewTriangles& fresh,
               const std::vector<std::uint8_t>& dropped);

  BrickSurface& surface_;
  std::size_t first_, end_;
  Mesh mesh_;
  std::vector<BrickSurface::VertexOfBrick> names_;  // ascending
  std::vector<std::uint8_t> rim_;
  std::vector<TriangleOfBrick> triangles_;
};

}  // namespace rholm
