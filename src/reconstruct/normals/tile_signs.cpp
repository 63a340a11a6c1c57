#include "reconstruct/normals/tile_signs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "base/refuse.h"
#include "shape/points/members.h"
#include "shape/points/orient_signs.h"

namespace rholm {
namespace {

// Smaller pieces get no sign of their own (orient_sides.cpp) and follow others.
constexpr std::size_t kLeastPart = 30;

// Takes samples of the own points of each piece, one for a number of points in their order.
std::vector<SideSample> take_samples(const BareTile& graph, const OrientedPieces& pieces,
                                     const std::vector<Vec3>& normals,
                                     std::size_t points_per_sample) {
  const Patches patches =
      patches_of(graph.fits, graph.gaps, spread_of_graph(graph.fits.n_neighbors));
  const Members members(pieces.piece, pieces.n_pieces);
  std::vector<SideSample> samples;
  std::vector<std::uint32_t> own;
  for (std::uint32_t p = 0; p < pieces.n_pieces; ++p) {
    own.clear();
    for (const std::uint32_t i : members.of(p)) {
      if (graph.foreign[i] == 0 && norm(normals[i]) > 0) own.push_back(i);
    }
    const std::size_t of_each =
        std::max<std::size_t>(1, std::min(points_per_sample, own.size() / kLeastPart));
    for (std::size_t begin = 0; begin < own.size(); begin += of_each) {
      const std::size_t end = std::min(own.size(), begin + of_each);
      const std::uint32_t middle = own[(begin + end) / 2];
      double area = 0;
      for (std::size_t k = begin; k < end; ++k) area += patches.areas[own[k]];
      const double wider = std::sqrt(area / patches.areas[middle]);
      samples.push_back({.point = graph.points[middle],
                         .normal = normals[middle],
                         .area = area,
                         .spacing = wider * patches.spacing[middle],
                         .piece = p,
                         .place = graph.tree->order()[middle]});
    }
  }
  return samples;
}

template <class T>
std::vector<T> section(const PieceReader& piece, std::size_t k) {
  return piece.values<T>(k);
}

[[noreturn]] void refuse_signs() {
  refuse("a piece with signs of a tile does not fit; begin the run anew");
}

enum Section : std::size_t {
  kHead,
  kCodes,
  kWithin,
  kEdges,
  kAcross,
  kShared,
  kPlaces,
  kHalo,
  kVotes,
  kSamples,
  kSections
};

PieceReader open_signs(const PieceStore& store, std::size_t tile, TileSigns& signs) {
  PieceReader piece = store.open(signs_name(tile));
  if (piece.n_sections() != kSections) refuse_signs();
  const auto head = section<std::uint64_t>(piece, kHead);
  if (head.size() != 2) refuse_signs();
  signs.n_pieces = head[0];
  signs.in_rows = head[1] != 0;
  return piece;
}

}  // namespace

TileSigns find_tile_signs(const BareTile& graph, std::size_t points_per_sample) {
  const std::size_t n = graph.points.size(), n_own = graph.read.n_own;
  std::vector<Vec3> normals = graph.fits.normals;
  const OrientedPieces pieces =
      orient_pieces(graph.points, graph.fits, kLeastPart, graph.foreign, normals);
  const PieceAgreement sums =
      agreement_of_pieces(graph.points, graph.fits, pieces, graph.foreign, normals);
  TileSigns signs{.n_pieces = pieces.n_pieces, .in_rows = !graph.gaps.ratio.empty()};
  signs.codes.resize(n_own);
  signs.within.resize(n_own);
  signs.edges.resize(n_own);
  signs.halo.resize(n - n_own);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t given = graph.tree->order()[i];
    const PieceCode code(pieces.piece[i], dot(normals[i], graph.fits.normals[i]) < 0);
    if (given >= n_own) {
      signs.halo[given - n_own] = code;
      continue;
    }
    signs.codes[given] = code;
    signs.within[given] = sums.within[i];
    signs.edges[given] = sums.edges[i];
  }
  for (const PieceAgreement::Across& edge : sums.across) {
    signs.across.push_back({graph.tree->order()[edge.point], edge.other, edge.agreement});
  }
  for (const TileAndHalo::Part& part : graph.read.halo) {
    signs.shared.push_back({part.tile, part.places.size()});
    signs.places.insert(signs.places.end(), part.places.begin(), part.places.end());
  }
  signs.votes = pieces.votes;
  signs.samples = take_samples(graph, pieces, normals, points_per_sample);
  return signs;
}

std::string signs_name(std::size_t tile) { return "signs/" + std::to_string(tile); }
std::string votes_name(std::size_t tile) { return "votes/" + std::to_string(tile); }

void write_signs(PieceStore& store, std::size_t tile, const TileSigns& signs) {
  const std::uint64_t head[] = {signs.n_pieces, signs.in_rows ? 1U : 0U};
  const std::span<const std::byte> sections[kSections] = {
      bytes_of(std::span<const std::uint64_t>(head)),
      bytes_of(signs.codes),
      bytes_of(signs.within),
      bytes_of(signs.edges),
      bytes_of(signs.across),
      bytes_of(signs.shared),
      bytes_of(signs.places),
      bytes_of(signs.halo),
      bytes_of(signs.votes),
      bytes_of(signs.samples)};
  store.write(signs_name(tile), sections);
}

TileSigns read_signs(const PieceStore& store, std::size_t tile) {
  TileSigns signs;
  const PieceReader piece = open_signs(store, tile, signs);
  signs.codes = section<PieceCode>(piece, kCodes);
  signs.within = section<float>(piece, kWithin);
  signs.edges = section<std::uint8_t>(piece, kEdges);
  signs.across = section<TileSigns::Across>(piece, kAcross);
  signs.shared = section<TileSigns::Shared>(piece, kShared);
  signs.places = section<std::uint32_t>(piece, kPlaces);
  signs.halo = section<PieceCode>(piece, kHalo);
  if (signs.within.size() != signs.codes.size() || signs.edges.size() != signs.codes.size() ||
      signs.halo.size() != signs.places.size()) {
    refuse_signs();
  }
  return signs;
}

TileSigns read_pieces(const PieceStore& store, std::size_t tile) {
  TileSigns signs;
  const PieceReader piece = open_signs(store, tile, signs);
  signs.votes = section<PieceVotes>(piece, kVotes);
  signs.samples = section<SideSample>(piece, kSamples);
  return signs;
}

std::vector<PieceCode> read_codes(const PieceStore& store, std::size_t tile) {
  TileSigns signs;
  return section<PieceCode>(open_signs(store, tile, signs), kCodes);
}

std::vector<SharedVotes> match_signs(const PieceStore& store, std::size_t tile) {
  const TileSigns own = read_signs(store, tile);
  std::vector<SharedVotes> votes;
  std::size_t k = 0;
  for (const TileSigns::Shared& shared : own.shared) {
    const std::vector<PieceCode> others = read_codes(store, shared.tile);
    std::map<std::pair<std::uint32_t, std::uint32_t>, SharedVotes> of_pieces;
    for (const std::size_t end = k + shared.n; k < end; ++k) {
      const PieceCode here = own.halo.at(k), there = others.at(own.places.at(k));
      SharedVotes& sum = of_pieces[{here.piece(), there.piece()}];
      sum.sum += here.opposite() == there.opposite() ? 1 : -1;
      ++sum.n;
    }
    for (const auto& [pieces, sum] : of_pieces) {
      votes.push_back({.tile = shared.tile,
                       .own = pieces.first,
                       .other = pieces.second,
                       .sum = sum.sum,
                       .n = sum.n});
    }
  }
  return votes;
}

}  // namespace rholm
