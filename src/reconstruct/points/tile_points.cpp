#include "reconstruct/points/tile_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/refuse.h"
#include "reconstruct/caps/tile_caps.h"
#include "shape/on_line.h"

namespace rholm {
namespace {

constexpr std::size_t kTileBuffer = std::size_t{1} << 16;  // bytes

struct IndexHead {
  std::uint64_t points, duplicates, opposite_normals, chunks;
};

[[noreturn]] void refuse_index() {
  refuse("a piece with points of a tile has an index that does not fit; begin the run anew");
}

}  // namespace

void distribute(PointSource& source, const Survey& survey, const TilePlan& plan, PieceStore& store,
                const DistributeOptions& options, const Context& context) {
  if (store.has(kDistributed)) return;
  const std::size_t n = plan.n_tiles();
  PieceAppender appender(store, kRaw, n, std::max(options.buffer_bytes, n * kTileBuffer));
  std::vector<std::byte> row(survey.layout.row_bytes());
  std::uint64_t kept = 0, not_finite = 0, far = 0;
  PointCloud piece;
  source.rewind();
  while (source.next(piece, context)) {
    PointLayout layout = survey.layout;
    widen(layout, layout_of(piece));
    layout.normals = survey.layout.normals;
    if (!(layout == survey.layout)) refuse("the points are others than they were a moment ago");
    for (std::size_t i = 0; i < piece.points.size(); ++i) {
      const Vec3& p = piece.points[i];
      if (!is_finite(p)) {
        ++not_finite;
      } else if (survey.ball.is_far(p)) {
        ++far;
      } else {
        put_row(survey.layout, piece, i, row.data());
        appender.append(plan.tile_of(p), row);
        ++kept;
      }
    }
    ask_cancel();
    report_progress(context, "distribute", source.part_read());
  }
  if (kept != survey.points || not_finite != survey.not_finite || far != survey.far_isolated) {
    refuse(fmt::format(
        "the points have changed while they were read: there were {}, and there are "
        "{}",
        survey.points + survey.not_finite + survey.far_isolated, kept + not_finite + far));
  }
  appender.finish();
  const std::vector<std::byte> layout = layout_bytes(survey.layout);
  const std::span<const std::byte> sections[] = {layout, bytes_of(std::span(&survey.bounds, 1))};
  store.write(kDistributed, sections);
}

Distributed read_distributed(const PieceStore& store) {
  const PieceReader piece = store.open(kDistributed);
  if (piece.n_sections() != 2 || piece.size(1) != sizeof(Bounds)) {
    refuse("the points are laid out as another version does; begin the run anew");
  }
  return {.layout = parse_layout(piece.read(0)),
          .lattice = PlaceLattice(piece.values<Bounds>(1).front())};
}

// Head, chunks, layout.
std::vector<std::byte> index_bytes(const TileIndex& index) {
  const IndexHead head{.points = index.counts.points,
                       .duplicates = index.counts.duplicates,
                       .opposite_normals = index.counts.opposite_normals,
                       .chunks = index.chunks.size()};
  std::vector<std::byte> bytes;
  const auto put = [&](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  put(bytes_of(std::span(&head, 1)));
  put(bytes_of(index.chunks));
  put(layout_bytes(index.layout));
  return bytes;
}

TileIndex parse_index(const PieceReader& piece) {
  if (piece.n_sections() == 0) refuse_index();
  const std::vector<std::byte> bytes = piece.read(0);
  std::span<const std::byte> left = bytes;
  if (left.size() < sizeof(IndexHead)) refuse_index();
  const IndexHead head = vector_of<IndexHead>(left.first(sizeof(IndexHead))).front();
  left = left.subspan(sizeof(IndexHead));
  if (head.chunks != piece.n_sections() - 1 ||
      head.chunks > left.size() / sizeof(TileIndex::Chunk)) {
    refuse_index();
  }
  const std::size_t chunks = head.chunks * sizeof(TileIndex::Chunk);
  TileIndex index{.counts = {.points = head.points,
                             .duplicates = head.duplicates,
                             .opposite_normals = head.opposite_normals},
                  .layout = parse_layout(left.subspan(chunks)),
                  .chunks = vector_of<TileIndex::Chunk>(left.first(chunks))};
  const std::size_t row = index.layout.row_bytes();
  std::uint64_t points = 0;
  for (std::size_t k = 0; k < index.chunks.size(); ++k) {
    const std::uint64_t n = piece.size(k + 1) / row;
    if (index.chunks[k].points != n || n * row != piece.size(k + 1)) refuse_index();
    points += n;
  }
  if (points != head.points) refuse_index();
  return index;
}

Bounds TileIndex::bounds() const {
  if (chunks.empty()) return {};
  Bounds all = chunks.front().box;
  for (const Chunk& chunk : chunks) {
    all.min = {std::min(all.min.x, chunk.box.min.x), std::min(all.min.y, chunk.box.min.y),
               std::min(all.min.z, chunk.box.min.z)};
    all.max = {std::max(all.max.x, chunk.box.max.x), std::max(all.max.y, chunk.box.max.y),
               std::max(all.max.z, chunk.box.max.z)};
  }
  return all;
}

TileIndex read_index(const PieceStore& store, std::size_t tile) {
  return parse_index(store.open(sorted_name(tile)));
}

TilePoints read_points(const PieceStore& store, std::size_t tile) {
  const PieceReader piece = store.open(sorted_name(tile));
  const TileIndex index = parse_index(piece);
  TilePoints points = empty_cloud(index.layout);
  reserve_rows(index.layout, index.counts.points, points);
  for (std::size_t k = 0; k < index.chunks.size(); ++k) {
    take_rows(index.layout, piece.read(k + 1), points);
    ask_cancel();
  }
  return points;
}

void add_points_within(const PieceStore& store, std::size_t tile, const Bounds& box,
                       TilePoints& points, std::vector<std::uint32_t>* places) {
  const PieceReader piece = store.open(sorted_name(tile));
  const TileIndex index = parse_index(piece);
  if (points.points.empty()) points = empty_cloud(index.layout);
  std::uint64_t first = 0;
  std::vector<std::uint32_t> taken;
  for (std::size_t k = 0; k < index.chunks.size(); first += index.chunks[k++].points) {
    if (!meet(index.chunks[k].box, box)) continue;
    taken.clear();
    take_rows(index.layout, piece.read(k + 1), points, &box, &taken);
    if (places == nullptr) continue;
    for (const std::uint32_t i : taken) places->push_back(static_cast<std::uint32_t>(first + i));
    ask_cancel();
  }
}

Bounds bounds_of_tiles(const PieceStore& store, const TilePlan& plan) {
  Bounds all;
  bool is_first = true;
  for (std::size_t tile = 0; tile < plan.n_tiles(); ++tile) {
    const TileIndex index = read_index(store, tile);
    if (index.counts.points == 0) continue;
    const Bounds own = index.bounds();
    all = is_first ? own : joined(all, own);
    is_first = false;
  }
  return all;
}

bool lie_on_line(const PieceStore& store, const TilePlan& plan, double of_diagonal) {
  const double width = of_diagonal * bounds_of_tiles(store, plan).diagonal();
  std::vector<Vec3> first;  // points of tiles before, which lie on a line: two say which
  for (std::size_t tile = 0; tile < plan.n_tiles(); ++tile) {
    std::vector<Vec3> points = read_points(store, tile).points;
    points.insert(points.end(), first.begin(), first.end());
    if (!lie_on_line(points, width)) return false;
    if (points.size() < 2) continue;
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [](const Vec3& p, const Vec3& q) {
          return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
        });
    first = {*low, *high};
  }
  return true;
}

TilePoints read_points_within(const PieceStore& store, std::size_t tile, const Bounds& box) {
  TilePoints points;
  add_points_within(store, tile, box, points);
  return points;
}

}  // namespace rholm
