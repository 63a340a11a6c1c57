#include "reconstruct/normals/tile_mending.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/refuse.h"
#include "reconstruct/normals/tile_fit.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Least number of samples of each tile (chosen).
constexpr std::size_t kSamplesOfTile = 16;
constexpr const char* kJoined = "signs-joined";
constexpr const char* kMended = "signs-mended";
constexpr const char* kTurned = "normals-turned";

std::string pieces_name(std::size_t tile) { return "sign-pieces/" + std::to_string(tile); }
std::string links_name(std::size_t tile) { return "sign-links/" + std::to_string(tile); }
std::string turned_name(std::size_t tile) { return "turned/" + std::to_string(tile); }

[[noreturn]] void refuse_piece() {
  refuse("a piece with signs of a tile does not fit; begin the run anew");
}

// Points of the halo that another tile has.
struct Shared {
  std::uint64_t tile = 0, n = 0;
};

// A piece of a tile that is one with a piece of another tile.
struct SameLink {
  std::uint64_t tile = 0;  // the other one
  std::uint32_t own = 0, other = 0;
  friend bool operator==(const SameLink&, const SameLink&) = default;
};

// Contradicting points of a tile.
struct Count {
  std::uint64_t n = 0;
  std::array<Vec3, kNamedPoints> first = {};
};

// Sections of "sign-pieces/TILE".
enum Section : std::size_t {
  kScatter,
  kCodes,  // pieces of own points, in their order
  kOwn,
  kPairs,
  kQuarrels,  // of own points, in their order
  kSamples,
  kShared,  // by tiles
  kPlaces,  // of shared points, in their own tiles
  kHalo,    // pieces of shared points
  kSections
};

PieceReader open_pieces(const PieceStore& store, std::size_t tile) {
  PieceReader piece = store.open(pieces_name(tile));
  if (piece.n_sections() != kSections) refuse_piece();
  return piece;
}

// Sections of "signs-joined".
enum JoinedSection : std::size_t {
  kFirst,  // number of each tile's first piece, and the end
  kWhole,
  kTurned0,  // by check_signs() alone
  kTurnedAll,
  kWalls,
  kReport,
  kJoinedSections
};

template <class T>
T only(const PieceValues<T>& list) {
  if (list.size() != 1) refuse_piece();
  return list.front();
}
template <class T>
std::span<const std::byte> bytes_of_one(const T& value) {
  return bytes_of(std::span<const T>(&value, 1));
}

class TileMending {
 public:
  TileMending(PieceStore& store, std::size_t n_tiles, const TileMendingOptions& options)
      : store_(store), n_(n_tiles), options_(options) {}

  void find(std::size_t tile, const Context& context) const;
  void match(std::size_t tile) const;
  void join(const Context& context) const;
  void read_joined();
  void turn(std::size_t tile) const;
  void finish();

 private:
  AllPieces all_pieces(std::vector<std::uint64_t>& first, std::vector<SignSample>& samples) const;

  PieceStore& store_;
  std::size_t n_ = 0;
  const TileMendingOptions& options_;
  // What "signs-joined" has.
  std::vector<std::uint64_t> first_;
  SignCheck check_;
  std::vector<std::uint8_t> turned_;
};

std::vector<SignSample> samples_of(const TileScene& scene, const SignPieces& pieces,
                                   const TileMendingOptions& options, const Context& context) {
  const double share = static_cast<double>(scene.n_own) / static_cast<double>(options.points);
  const auto wanted =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(options.samples)));
  std::vector<SignSample> samples;
  for (const SamplePoint& point :
       sample_tile(scene, std::max(wanted, kSamplesOfTile), options.around, context)) {
    samples.push_back({.at = point.at,
                       .normal = point.normal,
                       .area = point.points * point.area,
                       .disc = point.points * point.disc,
                       .piece = pieces.piece[point.place]});
  }
  return samples;
}

void TileMending::find(std::size_t tile, const Context& context) const {
  if (store_.has(pieces_name(tile))) return;
  const std::shared_ptr<const TileScene> loaded = options_.load(tile);
  const TileScene& scene = *loaded;
  SignPieces found;
  std::vector<SignSample> samples;
  if (scene.n_own > 0) {
    found = find_sign_pieces(*scene.tree, scene.points, scene.normals, scene.gaps, scene.foreign,
                             context, options_.neighbors(tile));
    samples = samples_of(scene, found, options_, context);
  }
  const std::span<const std::uint32_t> order = scene.tree->order();
  std::vector<std::uint32_t> codes(scene.n_own), halo(order.size() - scene.n_own), places;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t given = order[i];
    (given < scene.n_own ? codes[given] : halo[given - scene.n_own]) = found.piece[i];
  }
  for (SignPieces::Quarrel& quarrel : found.quarrels) quarrel.point = order[quarrel.point];
  std::vector<Shared> shared;
  for (const TileAndHalo::Part& part : scene.halo) {
    shared.push_back({part.tile, part.places.size()});
    places.insert(places.end(), part.places.begin(), part.places.end());
  }
  const std::span<const std::byte> sections[kSections] = {bytes_of_one(found.scatter),
                                                          bytes_of(codes),
                                                          bytes_of(found.own),
                                                          bytes_of(found.pairs),
                                                          bytes_of(found.quarrels),
                                                          bytes_of(samples),
                                                          bytes_of(shared),
                                                          bytes_of(places),
                                                          bytes_of(halo)};
  store_.write(pieces_name(tile), sections);
}

void TileMending::match(std::size_t tile) const {
  if (store_.has(links_name(tile))) return;
  const PieceReader own = open_pieces(store_, tile);
  const auto places = own.values<std::uint32_t>(kPlaces), halo = own.values<std::uint32_t>(kHalo);
  std::vector<SameLink> links;
  std::size_t k = 0;
  for (const Shared& shared : own.values<Shared>(kShared)) {
    const auto others = open_pieces(store_, shared.tile).values<std::uint32_t>(kCodes);
    for (const std::size_t end = k + shared.n; k < end; ++k) {
      if (halo.at(k) == kNoPiece) continue;
      links.push_back({shared.tile, halo[k], others.at(places.at(k))});
    }
  }
  std::sort(links.begin(), links.end(), [](const SameLink& x, const SameLink& y) {
    return std::tie(x.tile, x.own, x.other) < std::tie(y.tile, y.own, y.other);
  });
  links.erase(std::unique(links.begin(), links.end()), links.end());
  const std::span<const std::byte> sections[] = {bytes_of(links)};
  store_.write(links_name(tile), sections);
}

AllPieces TileMending::all_pieces(std::vector<std::uint64_t>& first,
                                  std::vector<SignSample>& samples) const {
  AllPieces all;
  std::vector<double> scatters;
  std::uint64_t bytes = 0;
  first = {0};
  for (std::size_t tile = 0; tile < n_; ++tile) {
    const PieceReader piece = open_pieces(store_, tile);
    bytes += 4 * (piece.size(kOwn) + piece.size(kPairs));
    if (bytes > options_.max_memory || first.back() > kNoPiece / 2) {
      throw Error(ErrorCode::kOutOfMemory,
                  fmt::format("the normals are in more than {} pieces that contradict each other, "
                              "which do not fit into {:.3g} GiB: are they right? 'rholm orient' "
                              "finds them anew",
                              first.back(), static_cast<double>(options_.max_memory) / 0x1p30));
    }
    const auto shift = static_cast<std::uint32_t>(first.back());
    const auto own = piece.values<std::uint64_t>(kOwn);
    all.own.insert(all.own.end(), own.begin(), own.end());
    for (PiecePair pair : piece.values<PiecePair>(kPairs)) {
      pair.a += shift, pair.b += shift;
      all.pairs.push_back(pair);
    }
    for (SignSample sample : piece.values<SignSample>(kSamples)) {
      sample.piece += shift;
      samples.push_back(sample);
    }
    if (!own.empty()) scatters.push_back(only(piece.values<double>(kScatter)));
    first.push_back(first.back() + own.size());
  }
  for (std::size_t tile = 0; tile < n_; ++tile) {
    for (const SameLink& link : store_.open(links_name(tile)).values<SameLink>(0)) {
      all.same.emplace_back(first[tile] + link.own, first.at(link.tile) + link.other);
    }
  }
  std::sort(scatters.begin(), scatters.end());
  all.scatter = scatters.empty() ? 0 : scatters[scatters.size() / 2];
  return all;
}

void TileMending::join(const Context& context) const {
  if (store_.has(kJoined)) return;
  std::vector<std::uint64_t> first;
  std::vector<SignSample> samples;
  const AllPieces all = all_pieces(first, samples);
  MendedSigns mended;
  if (options_.mend) {
    mended = mend_signs(all, std::move(samples), options_.closed, context);
  } else {
    mended.check = check_signs(all, {}, context);
    mended.turned.resize(all.own.size());
  }
  const SignCheck& check = mended.check;
  const TileMendingReport report{.turned = mended.n_turned,
                                 .all_inward = mended.all_inward ? 1U : 0U,
                                 .contradicting = options_.mend ? check.undecided : 0,
                                 .named = 0,
                                 .first = {},
                                 .inward = mended.inward};
  const std::span<const std::byte> sections[kJoinedSections] = {
      bytes_of(first),         bytes_of(check.whole), bytes_of(check.turned),
      bytes_of(mended.turned), bytes_of(check.walls), bytes_of_one(report)};
  store_.write(kJoined, sections);
}

void TileMending::read_joined() {
  const PieceReader piece = store_.open(kJoined);
  if (piece.n_sections() != kJoinedSections) refuse_piece();
  first_ = piece.values<std::uint64_t>(kFirst);
  check_.whole = piece.values<std::uint32_t>(kWhole);
  check_.turned = piece.values<std::uint8_t>(kTurned0);
  check_.walls = piece.values<SignCheck::Walls>(kWalls);
  turned_ = piece.values<std::uint8_t>(kTurnedAll);
}

void TileMending::turn(std::size_t tile) const {
  if (store_.has(turned_name(tile))) return;
  const PieceReader piece = open_pieces(store_, tile);
  SignPieces part;
  part.piece = piece.values<std::uint32_t>(kCodes);
  part.quarrels = piece.values<SignPieces::Quarrel>(kQuarrels);
  const auto first = static_cast<std::uint32_t>(first_.at(tile));
  const auto found = contradicting_points(part, first, check_, options_.mend);
  Count count{.n = found.size(), .first = {}};
  if (count.n > 0) {
    const PointCloud own = read_points(store_, tile);
    for (std::size_t k = 0; k < std::min(found.size(), kNamedPoints); ++k) {
      count.first[k] = own.points.at(found[k]);
    }
  }
  std::vector<std::uint8_t> flags;
  flags.reserve(part.piece.size());
  for (const std::uint32_t code : part.piece) flags.push_back(turned_.at(first + code));
  const std::span<const std::byte> sections[] = {bytes_of_one(count), bytes_of(flags)};
  store_.write(turned_name(tile), sections);
}

void TileMending::finish() {
  auto report = only(store_.open(kJoined).values<TileMendingReport>(kReport));
  std::size_t named = 0;
  for (std::size_t tile = 0; tile < n_; ++tile) {
    const Count count = only(store_.open(turned_name(tile)).values<Count>(0));
    for (std::size_t k = 0; k < std::min<std::size_t>(count.n, kNamedPoints); ++k) {
      if (named < kNamedPoints) report.first[named++] = count.first[k];
    }
    report.contradicting += count.n;
  }
  report.named = named;
  const std::span<const std::byte> sections[] = {bytes_of_one(report)};
  if (report.turned > 0) store_.write(kTurned, sections);
  store_.write(kMended, sections);
  for (std::size_t tile = 0; tile < n_; ++tile) {
    store_.remove(pieces_name(tile)), store_.remove(links_name(tile));
    if (report.turned == 0) store_.remove(turned_name(tile));
  }
  store_.remove(kJoined);
}

}  // namespace

TileMendingReport mend_tiles(PieceStore& store, const TilePlan& plan,
                             const TileMendingOptions& options, Stages& stages) {
  const std::size_t n = plan.n_tiles();
  if (!store.has(kMended)) {
    TileMending mending(store, n, options);
    const Context& context = stages.context();
    stages.each("signs", n, [&](std::size_t tile) { mending.find(tile, context); });
    stages.each("signs", n, [&](std::size_t tile) { mending.match(tile); });
    stages.once("signs", [&] { mending.join(context); });
    stages.all("signs", [&] { mending.read_joined(); });
    stages.each("signs", n, [&](std::size_t tile) { mending.turn(tile); });
    stages.once("signs", [&] { mending.finish(); });
  }
  return only(store.open(kMended).values<TileMendingReport>(0));
}

bool have_turned(const PieceStore& store) { return store.has(kTurned); }

std::vector<std::uint8_t> read_turned(const PieceStore& store, std::size_t tile) {
  return store.open(turned_name(tile)).values<std::uint8_t>(1);
}

void remove_turned(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& gone) {
  const std::vector<std::uint8_t> flags = read_turned(store, tile);
  const Count count = only(store.open(turned_name(tile)).values<Count>(0));
  std::vector<std::uint8_t> kept;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (gone.at(i) == 0) kept.push_back(flags[i]);
  }
  const std::span<const std::byte> sections[] = {bytes_of_one(count), bytes_of(kept)};
  store.write(turned_name(tile), sections);
}

}  // namespace rholm
