// Points go through tiles and back: none is lost, doubled or changed, except as in clean().
#include "reconstruct/points/tile_points.h"

#include <gtest/gtest.h>

#include <map>

#include "io/spill/folder_store.h"
#include "parts/memory_store.h"
#include "reconstruct/test_support.h"
#include "rholm/error.h"
#include "rholm/points.h"

namespace rholm {
namespace {

using testing::all_points;
using testing::bytes_of_piece;
using testing::chosen;
using testing::expect_error;
using testing::shuffled;
using testing::sorted_rows;
using testing::sphere_points;
using testing::TemporaryFolder;
using testing::Tiles;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(tile_points, are_the_points_that_were_given) {
  PointCloud cloud = sphere_points(20000);
  cloud.attributes.push_back({"real", ScalarType::kFloat64, {}});
  for (std::size_t i = 0; i < 20000; ++i) {
    cloud.attributes[2].values.push_back(random_uniform(3, i));
  }
  cloud.points[7] = {kNan, 0, 0};
  cloud.points[8] = {1e6, 0, 0};
  cloud.normals[9] = {kNan, 0, 1};  // dropped, because other normals have directions
  MemoryStore store;
  const Tiles tiles(*points_in_memory(cloud), store, 700);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < 20000; ++i) {
    if (i < 7 || i > 9) kept.push_back(i);
  }
  const PointCloud found = all_points(store, tiles.plan);
  EXPECT_EQ(sorted_rows(found), sorted_rows(chosen(cloud, kept)));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(found.attributes[k].name, cloud.attributes[k].name);
    EXPECT_EQ(found.attributes[k].type, cloud.attributes[k].type);
  }
  for (std::size_t k = 0; k < tiles.plan.n_tiles(); ++k) {
    EXPECT_FALSE(store.has(raw_name(k)));
    for (const Vec3& p : read_points(store, k).points) EXPECT_EQ(tiles.plan.tile_of(p), k);
  }
}

TEST(tile_points, of_another_order_are_the_same_bytes) {
  PointCloud cloud = sphere_points(15000);
  // Some points occur two or three times, with other normals, and with 0 and -0.
  for (std::size_t i = 0; i < 300; ++i) {
    cloud.points[i + 1000] = cloud.points[i % 100];
    cloud.attributes[0].values[i + 1000] = cloud.attributes[0].values[i % 100];
    cloud.attributes[1].values[i + 1000] = cloud.attributes[1].values[i % 100];
  }
  cloud.points[0].x = 0.0;
  cloud.points[1000] = cloud.points[0];
  cloud.points[1000].x = -0.0;
  const PointCloud other = shuffled(cloud);
  const TemporaryFolder folder;
  MemoryStore first;
  FolderStore second(folder / "second");
  const Tiles a(*points_in_memory(cloud), first, 400), b(*points_in_memory(other), second, 400);
  ASSERT_EQ(a.plan.n_tiles(), b.plan.n_tiles());
  EXPECT_GT(a.plan.n_tiles(), 30u);
  EXPECT_EQ(a.counts, b.counts);
  EXPECT_GT(a.counts.duplicates, 200u);
  for (std::size_t k = 0; k < a.plan.n_tiles(); ++k) {
    EXPECT_EQ(bytes_of_piece(first, sorted_name(k)), bytes_of_piece(second, sorted_name(k)));
  }
}

// Twins are at most about a cell apart, in tiles of few points: many lie beside cuts.
PointCloud twins() {
  PointCloud cloud = sphere_points(10000);
  const PointCloud more = sphere_points(10000);
  for (std::size_t i = 0; i < 10000; ++i) {
    Vec3 p = more.points[i];
    p.x += 4e-7 * random_uniform(6, i);
    p.y += 4e-7 * random_uniform(7, i);
    cloud.points.push_back(p);
    cloud.normals.push_back(i % 5 == 0 ? -more.normals[i] : more.normals[i]);
    for (std::size_t k = 0; k < 2; ++k) {
      cloud.attributes[k].values.push_back(k == 0 ? static_cast<double>(10000 + i) : 7);
    }
  }
  return cloud;
}

TEST(tile_points, are_merged_as_the_whole_cloud_is) {
  PointCloud cloud = twins();
  MemoryStore store;
  const Tiles tiles(*points_in_memory(cloud), store, 30);
  const PointCloud found = all_points(store, tiles.plan);
  const PlaceLattice lattice(bounds(cloud.points));
  const CleanReport report = clean(cloud);
  EXPECT_EQ(tiles.counts.points, cloud.points.size());
  EXPECT_EQ(found.points.size(), cloud.points.size());
  EXPECT_EQ(tiles.counts.duplicates, report.duplicates);
  EXPECT_EQ(tiles.counts.opposite_normals, report.opposite_normals);
  EXPECT_GT(report.duplicates, 1000u);
  EXPECT_GT(report.opposite_normals, 100u);
  // Each place has the attributes of its first point in the file.
  std::map<testing::Row, double> index_at;
  const auto place = [&](const Vec3& p) {
    const Vec3 cell = lattice.cell_of(p);
    return testing::Row{cell.x, cell.y, cell.z};
  };
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    index_at[place(cloud.points[i])] = cloud.attributes[0].values[i];
  }
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    EXPECT_EQ(index_at.at(place(found.points[i])), found.attributes[0].values[i]);
  }
}

TEST(tile_points, within_a_box_are_those_of_a_search_through_all) {
  const PointCloud cloud = sphere_points(60000);
  MemoryStore store;
  const Tiles tiles(*points_in_memory(cloud), store, 20000);
  for (std::size_t k = 0; k < tiles.plan.n_tiles(); ++k) {
    const TilePoints all = read_points(store, k);
    const TileIndex index = read_index(store, k);
    EXPECT_EQ(index.counts.points, all.points.size());
    EXPECT_EQ(index.bounds().min, bounds(all.points).min);
    EXPECT_EQ(index.bounds().max, bounds(all.points).max);
    for (std::size_t i = 0; i < 20; ++i) {
      const Vec3 a = all.points[random_bits(1, i) % all.points.size()];
      const Vec3 b = all.points[random_bits(2, i) % all.points.size()];
      const Bounds box{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                       {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
      std::vector<std::size_t> wanted;
      for (std::size_t j = 0; j < all.points.size(); ++j) {
        if (is_within(box, all.points[j])) wanted.push_back(j);
      }
      EXPECT_GE(wanted.size(), 2u);
      const TilePoints found = read_points_within(store, k, box);
      const PointCloud there = chosen(all, wanted);
      EXPECT_EQ(found.points, there.points);
      EXPECT_EQ(found.normals, there.normals);
      EXPECT_EQ(found.attributes[0].values, there.attributes[0].values);
      EXPECT_EQ(found.attributes[1].values, there.attributes[1].values);
    }
    EXPECT_TRUE(read_points_within(store, k, {{5, 5, 5}, {6, 6, 6}}).points.empty());
  }
}

TEST(tile_points, lie_near_each_other_in_chunks) {
  const PointCloud cloud = sphere_points(100000);
  MemoryStore store;
  const Tiles tiles(*points_in_memory(cloud), store, 1000000);
  const TileIndex index = read_index(store, 0);
  ASSERT_EQ(index.chunks.size(), (100000 + kChunkPoints - 1) / kChunkPoints);
  double sum = 0;
  for (const TileIndex::Chunk& chunk : index.chunks) sum += chunk.box.diagonal();
  // 25 chunks of 4 pi have 0.7 x 0.7 each; in random order each chunk would have 3.4.
  EXPECT_LT(sum / 25, 1.7);
}

// A source that ends early with an error.
class Interrupted final : public PointSource {
 public:
  Interrupted(const PointCloud& cloud, int pieces)
      : source_(points_in_memory(cloud)), pieces_(pieces) {}
  void rewind() override { source_->rewind(); }
  bool next(PointCloud& piece, const Context& context) override {
    if (pieces_-- == 0) throw Error(ErrorCode::kCancelled, "enough");
    return source_->next(piece, context);
  }
  std::optional<std::uint64_t> size() const override { return source_->size(); }
  double part_read() const override { return source_->part_read(); }

 private:
  std::unique_ptr<PointSource> source_;
  int pieces_;
};

TEST(tile_points, are_finished_by_another_run) {
  const PointCloud cloud = sphere_points(50000);
  MemoryStore whole;
  const Tiles wanted(*points_in_memory(cloud), whole, 5000);
  const TemporaryFolder folder;
  {
    FolderStore store(folder / "run");
    store.keep(true);
    write_survey(wanted.found, store);
    Interrupted source(cloud, 2);
    expect_error([&] { distribute(source, wanted.found, wanted.plan, store, {}); },
                 ErrorCode::kCancelled);
    EXPECT_FALSE(store.has(raw_name(0)));
  }
  {
    FolderStore store(folder / "run");
    store.keep(true);
    const Survey found = *read_survey(store);
    const TilePlan plan = make_plan(found, 5000);
    distribute(*points_in_memory(cloud), found, plan, store, {});
    for (std::size_t k = 0; k < plan.n_tiles() / 2; ++k) sort_points(store, k);
  }
  FolderStore store(folder / "run");
  Interrupted never(cloud, 0);
  distribute(never, wanted.found, wanted.plan, store, {});  // all parts exist already
  SortedTile counts;
  for (std::size_t k = 0; k < wanted.plan.n_tiles(); ++k) {
    counts.points += sort_points(store, k).points;
    EXPECT_EQ(bytes_of_piece(store, sorted_name(k)), bytes_of_piece(whole, sorted_name(k)));
    EXPECT_FALSE(store.has(raw_name(k)));
  }
  EXPECT_EQ(counts.points, wanted.counts.points);
}

TEST(tile_points, of_a_file_that_changes_are_refused) {
  const PointCloud cloud = sphere_points(1000);
  const Survey found = survey(*points_in_memory(cloud));
  const TilePlan plan = make_plan(found, 100);
  MemoryStore store;
  PointCloud other = cloud;
  other.points[3].x = 0.1;  // does not fit into single precision
  expect_error([&] { distribute(*points_in_memory(other), found, plan, store); },
               ErrorCode::kInvalidInput, {"others"});
  other = chosen(cloud, {1, 2, 3});
  expect_error([&] { distribute(*points_in_memory(other), found, plan, store); },
               ErrorCode::kInvalidInput, {"changed", "1000", "3"});
  other.attributes.pop_back();
  expect_error([&] { distribute(*points_in_memory(other), found, plan, store); },
               ErrorCode::kInvalidInput, {"attributes"});
  EXPECT_FALSE(store.has(raw_name(0)));
}

TEST(tile_points, that_are_damaged_are_refused) {
  const PointCloud cloud = sphere_points(300);
  MemoryStore store;
  const Tiles tiles(*points_in_memory(cloud), store, 1000);
  const auto whole = bytes_of_piece(store, sorted_name(0));
  const auto read = [&] {
    read_points(store, 0);
    read_points_within(store, 0, {{-1, -1, -1}, {1, 1, 1}});
  };
  const auto expect_refused = [&](const std::vector<std::vector<std::byte>>& sections) {
    store.write(sorted_name(0), sections);
    expect_error(read, ErrorCode::kInvalidInput, {"begin the run anew"});
  };
  expect_refused({});
  expect_refused({whole[0]});
  expect_refused({whole[1], whole[0]});
  expect_refused({whole[0], whole[1], whole[1]});
  for (std::size_t n = 0; n < whole[0].size(); ++n) {
    SCOPED_TRACE(n);
    auto sections = whole;
    sections[0].resize(n);
    store.write(sorted_name(0), sections);
    // Without its last bytes the layout has fewer columns, which the rows do not fit.
    expect_error(read, ErrorCode::kInvalidInput);
  }
  auto sections = whole;
  sections[1].pop_back();
  expect_refused(sections);
  store.write(kDistributed, std::vector<std::vector<std::byte>>{{}});
  store.remove(sorted_name(0));
  expect_error([&] { sort_points(store, 0); }, ErrorCode::kInvalidInput, {"begin the run anew"});
}

}  // namespace
}  // namespace rholm
