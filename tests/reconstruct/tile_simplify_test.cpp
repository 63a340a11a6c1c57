#include "reconstruct/surface/tile_simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "parts/memory_store.h"
#include "reconstruct/caps/tile_caps.h"
#include "reconstruct/field/tile_winding.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/reconstruct_checks.h"

namespace rholm {
namespace {

constexpr double kRing = 1.0, kTube = 0.4;

double distance_to_torus(const Vec3& x) {
  return std::hypot(std::hypot(x.x, x.y) - kRing, x.z) - kTube;
}

double rms_of_middles(const Mesh& mesh) {
  double sum = 0, all = 0;
  for (const Triangle& t : mesh.faces) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double area = norm(cross(b - a, c - a));
    sum += area * std::pow(distance_to_torus((1.0 / 3) * (a + b + c)), 2);
    all += area;
  }
  return std::sqrt(sum / all);
}

// A mesh cut into tiles. Each triangle belongs to the tile of its middle, each vertex to the tile
// of its first triangle.
class TilesOfMesh {
 public:
  TilesOfMesh(const Mesh& mesh, double vertices_per_tile)
      : plan_(make_plan(mesh.vertices, PlaceLattice(bounds(mesh.vertices)),
                        static_cast<double>(mesh.vertices.size()), vertices_per_tile)),
        n_(plan_.n_tiles()),
        caps_(store_, n_) {
    for (std::size_t tile = 0; tile < n_; ++tile) caps_.write(tile, {}, {});
    caps_.read_extents();
    caps_.set_scene({}, 0.01);
    winding_ = std::make_unique<TileWinding>(caps_, n_, 4);
    surface_ = std::make_unique<TileSurface>(store_, plan_, caps_, *winding_, Vec3{});
    cut(mesh);
  }

  struct Result {
    Mesh mesh;
    double error = 0;
  };
  Result simplified(const SimplifyOptions& stops, std::size_t group) {
    TileParts parts(store_, *surface_, n_);
    const TileParts::Whole whole = joined(parts);
    TileSimplify less(store_, *surface_, parts, n_,
                      {.stops = stops, .faces = whole.faces, .step = 0.02, .group = group});
    if (less.wants_curves()) {
      for (std::size_t tile = 0; tile < n_; ++tile) less.find_curve(tile, {});
    }
    less.choose();
    for (std::size_t level = 0; level < less.n_levels(); ++level) {
      less.begin(level);
      for (std::size_t k = less.n_groups(); k-- > 0;) less.work(k, {});
      less.end();
      less.take();
    }
    TileParts simple(store_, *surface_, n_, "-simple");
    joined(simple);
    Result result{.mesh = {}, .error = less.error()};
    for (std::size_t tile = 0; tile < n_; ++tile) {
      const PlyPart part = simple.part(tile);
      const auto& vertices = part.vertices.vertices;
      result.mesh.vertices.insert(result.mesh.vertices.end(), vertices.begin(), vertices.end());
      for (const auto& t : part.faces) {
        result.mesh.faces.push_back({static_cast<std::uint32_t>(t[0]),
                                     static_cast<std::uint32_t>(t[1]),
                                     static_cast<std::uint32_t>(t[2])});
      }
    }
    return result;
  }

 private:
  TileParts::Whole joined(TileParts& parts) const {
    for (std::size_t tile = 0; tile < n_; ++tile) parts.find(tile, {});
    return parts.join(0);
  }

  void cut(const Mesh& mesh) {
    std::vector<std::uint32_t> tile, number(mesh.vertices.size(), 0);
    std::vector<std::uint32_t> owner(mesh.vertices.size(), ~0U);
    std::vector<TileMesh> parts(n_);
    const auto add = [&](TileMesh& part, std::uint32_t v) {
      part.mesh.vertices.push_back(mesh.vertices[v]);
      for (std::size_t k = 0; k < 3; ++k) part.mesh.attributes[k].values.push_back(k == 2 ? 1 : 0);
    };
    for (TileMesh& part : parts) {
      for (const char* axis : {"nx", "ny", "nz"}) {
        part.mesh.attributes.push_back({axis, ScalarType::kFloat32, {}});
      }
    }
    for (const Triangle& t : mesh.faces) {
      const Vec3 sum = mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]];
      tile.push_back(static_cast<std::uint32_t>(plan_.tile_of((1.0 / 3) * sum)));
      for (const std::uint32_t v : t) {
        if (owner[v] != ~0U) continue;
        owner[v] = tile.back();
        number[v] = static_cast<std::uint32_t>(parts[owner[v]].n_own++);
        add(parts[owner[v]], v);
      }
    }
    std::vector<std::map<VertexKey, std::uint32_t>> foreign(n_);
    for (std::size_t t = 0; t < tile.size(); ++t) {
      for (const std::uint32_t v : mesh.faces[t]) {
        if (owner[v] != tile[t]) foreign[tile[t]][VertexKey::direct(owner[v], number[v])] = v;
      }
    }
    for (std::size_t b = 0; b < n_; ++b) {
      std::map<std::uint32_t, std::uint32_t> place;
      for (const auto& [key, v] : foreign[b]) {
        place[v] = static_cast<std::uint32_t>(parts[b].mesh.vertices.size());
        parts[b].foreign.push_back(key);
        add(parts[b], v);
      }
      for (std::size_t t = 0; t < tile.size(); ++t) {
        if (tile[t] != b) continue;
        Triangle own = mesh.faces[t];
        for (std::uint32_t& v : own) v = owner[v] == b ? number[v] : place.at(v);
        parts[b].mesh.faces.push_back(own);
      }
      surface_->write_mesh(b, parts[b]);
    }
  }

  TilePlan plan_;
  std::size_t n_;
  MemoryStore store_;
  TileCaps caps_;
  std::unique_ptr<TileWinding> winding_;
  std::unique_ptr<TileSurface> surface_;
};

// Groups of two tiles, then of four, then all together; or all tiles at once.
TEST(tile_simplify, is_as_good_as_of_the_whole_in_groups_of_any_size) {
  const Mesh mesh = torus(kRing, kTube, 300, 120);
  const Simplification whole = simplify(mesh, {.faces = 6000});
  for (const std::size_t group : {2U, 64U}) {
    const TilesOfMesh::Result found = TilesOfMesh(mesh, 5000).simplified({.faces = 6000}, group);
    EXPECT_EQ(found.mesh.faces.size(), 6000U);
    const Inspection inspection = test::expect_closed_manifold(found.mesh);
    EXPECT_EQ(inspection.components, 1U);
    EXPECT_EQ(inspection.genus, 1);
    EXPECT_LT(rms_of_middles(found.mesh), 1.15 * rms_of_middles(whole.mesh)) << group;
    EXPECT_LT(found.error, 2 * whole.error);
  }
}

TEST(tile_simplify, keeps_the_error_that_is_allowed) {
  const Mesh mesh = torus(kRing, kTube, 300, 120);
  const double allowed = 2e-4;
  const Simplification whole = simplify(mesh, {.max_error = allowed});
  const TilesOfMesh::Result found = TilesOfMesh(mesh, 5000).simplified({.max_error = allowed}, 2);
  test::expect_closed_manifold(found.mesh);
  EXPECT_LE(found.error, allowed * (1 + 1e-4));
  const auto n = static_cast<double>(whole.mesh.faces.size());
  EXPECT_NEAR(static_cast<double>(found.mesh.faces.size()), n, 0.02 * n);
  // The error does not allow the requested share.
  const TilesOfMesh::Result both =
      TilesOfMesh(mesh, 5000).simplified({.share = 0.01, .max_error = allowed}, 64);
  EXPECT_LE(both.error, allowed * (1 + 1e-4));
  EXPECT_NEAR(static_cast<double>(both.mesh.faces.size()), n, 0.02 * n);
}

TEST(tile_simplify, of_one_tile_is_that_of_the_whole) {
  const Mesh mesh = torus(kRing, kTube, 100, 40);
  const TilesOfMesh::Result found = TilesOfMesh(mesh, 1e6).simplified({.faces = 1000}, 64);
  EXPECT_EQ(found.mesh.faces.size(), 1000U);
  EXPECT_NEAR(rms_of_middles(found.mesh), rms_of_middles(simplify(mesh, {.faces = 1000}).mesh),
              0.02 * rms_of_middles(found.mesh));  // in another order and another unit
}

}  // namespace
}  // namespace rholm
