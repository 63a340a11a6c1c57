#include "reconstruct/cloud/load_tile.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/large_vector.h"
#include "base/parallel.h"
#include "reconstruct/normals/tile_mending.h"
#include "reconstruct/normals/tile_normals.h"
#include "reconstruct/points/tile_halo.h"

namespace rholm {
namespace {

// Sets the computed normals of a tile and its halo, and removes the points without a normal.
// Returns the confidence of the points that remain.
std::vector<float> put_normals(const PieceStore& store, std::size_t tile, TileAndHalo& read) {
  const auto found =
      gather<TileNormal>(read, tile, [&](std::size_t other) { return read_normals(store, other); });
  PointCloud& cloud = read.cloud;
  cloud.normals.resize(cloud.points.size());
  std::vector<float> confidence;
  std::size_t kept = 0, own = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 normal = found.at(i).normal();
    if (normal == Vec3{}) continue;
    own += i < read.n_own ? 1 : 0;
    cloud.points[kept] = cloud.points[i];
    cloud.normals[kept] = normal;
    for (Attribute& attribute : cloud.attributes) attribute.values[kept] = attribute.values[i];
    confidence.push_back(found[i].confidence);
    ++kept;
  }
  if (kept == cloud.points.size()) return confidence;
  cloud.points.resize(kept), cloud.normals.resize(kept);
  for (Attribute& attribute : cloud.attributes) attribute.values.resize(kept);
  read.n_own = own;
  read.halo.clear();  // its places are no longer valid
  return confidence;
}

void turn_normals(const PieceStore& store, std::size_t tile, TileAndHalo& read) {
  const auto turned = gather<std::uint8_t>(
      read, tile, [&](std::size_t other) { return read_turned(store, other); });
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (turned[i] != 0) read.cloud.normals.at(i) = -read.cloud.normals[i];
  }
}

}  // namespace

TileScene load_tile(const PieceStore& store, const TilePlan& plan, std::size_t tile, double halo,
                    const Context& context, std::unique_ptr<PointTree> tree) {
  TileScene scene;
  TileAndHalo read = read_with_halo(store, plan, tile, halo);
  std::vector<float> confidence;
  if (have_normals(store)) confidence = put_normals(store, tile, read);
  if (have_turned(store)) turn_normals(store, tile, read);
  scene.normal_neighbors = normal_neighbors(store);
  scene.n_own = read.n_own;
  scene.halo = std::move(read.halo);
  const bool fits = tree && tree->size() == read.cloud.points.size();
  scene.tree = fits ? std::move(tree) : std::make_unique<PointTree>(read.cloud.points, context);
  const std::size_t n = scene.tree->size();
  const bool directed = !read.cloud.normals.empty();
  scene.points.resize(n);
  scene.foreign.resize(n);
  if (directed) scene.normals.resize(n);
  if (scene.normal_neighbors > 0) scene.confidence.resize(n);
  parallel_for(n, 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t given = scene.tree->order()[i];
      scene.points[i] = read.cloud.points[given];
      scene.foreign[i] = given >= scene.n_own;
      if (directed) scene.normals[i] = normalized(read.cloud.normals[given]);
      if (scene.normal_neighbors > 0) scene.confidence[i] = confidence[given];
    }
  });
  scene.attributes = std::move(read.cloud.attributes);
  release(read.cloud.points), release(read.cloud.normals);
  if (n > 0) scene.gaps = find_gaps(*scene.tree, scene.points, scene.normals, context);
  return scene;
}

}  // namespace rholm
