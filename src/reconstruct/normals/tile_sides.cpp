#include "reconstruct/normals/tile_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/cancel.h"
#include "base/signed_sets.h"
#include "reconstruct/normals/tile_signs.h"
#include "rholm/error.h"
#include "shape/points/orient_sides.h"

namespace rholm {
namespace {

// Votes between two pieces of all tiles, a < b.
struct Link {
  std::uint32_t a = 0, b = 0;
  double sum = 0, n = 0;

  // Grows with the number of votes and with their agreement on the sign of the sum.
  double confidence() const { return n > 0 ? sum * sum / n : 0; }
};

Link make_link(std::uint64_t a, std::uint64_t b, double sum, double n) {
  const auto [least, most] = std::minmax(a, b);
  return {static_cast<std::uint32_t>(least), static_cast<std::uint32_t>(most), sum, n};
}

// Adds up the links of each pair of pieces, and sorts them by pairs.
void merge(std::vector<Link>& links) {
  std::stable_sort(links.begin(), links.end(), [](const Link& x, const Link& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  });
  std::size_t n = 0;
  for (const Link& link : links) {
    if (n > 0 && links[n - 1].a == link.a && links[n - 1].b == link.b) {
      links[n - 1].sum += link.sum;
      links[n - 1].n += link.n;
    } else {
      links[n++] = link;
    }
  }
  links.resize(n);
}

std::vector<std::uint32_t> number_sets(SignedSets& sets, std::size_t n, std::size_t& count) {
  std::vector<std::uint32_t> number(n);
  count = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t first = sets.find(i).set;
    number[i] = first == i ? static_cast<std::uint32_t>(count++) : number[first];
  }
  return number;
}

class Joining {
 public:
  Joining(const PieceStore& store, std::size_t n_tiles) {
    sides_.first = {0};
    sides_.first_sample = {0};
    for (std::size_t tile = 0; tile < n_tiles; ++tile) {
      TileSigns signs = read_pieces(store, tile);
      sides_.in_rows |= signs.in_rows;
      const std::uint64_t first = sides_.first.back();
      for (SideSample& sample : signs.samples) {
        sample.piece += first;
        samples_.push_back(sample);
      }
      sides_.first_sample.push_back(samples_.size());
      for (const PieceVotes& votes : signs.votes) {
        doubtful_.push_back(make_link(first + votes.a, first + votes.b, votes.sum, 0));
      }
      sides_.first.push_back(first + signs.n_pieces);
      ask_cancel();
    }
    if (sides_.first.back() > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::kUnsupported,
                  "the points are in more than 2^32 pieces: they are noise, or too few for their "
                  "surface");
    }
    for (std::size_t tile = 0; tile < n_tiles; ++tile) {
      const auto votes = store.open(votes_name(tile)).values<SharedVotes>(0);
      for (const SharedVotes& v : votes) {
        shared_.push_back(make_link(sides_.first[tile] + v.own, sides_.first.at(v.tile) + v.other,
                                    static_cast<double>(v.sum), static_cast<double>(v.n)));
      }
    }
    merge(shared_);
  }

  JoinedSides join(const Context& context) {
    const std::size_t n = n_pieces();
    SignedSets sets(n);
    unite_shared(sets);
    std::size_t n_wholes = 0;
    const std::vector<std::uint32_t> whole = number_sets(sets, n, n_wholes);
    unite_doubtful(sets);
    std::size_t n_components = 0;
    sides_.component = number_sets(sets, n, n_components);
    sides_.turned.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) sides_.turned[i] = sets.find(i).opposite ? 1 : 0;
    turn_samples(whole, n_wholes, n_components, context);
    sides_.samples = std::move(samples_);
    return std::move(sides_);
  }

 private:
  std::size_t n_pieces() const { return sides_.first.back(); }

  // Unites pieces where most votes agree; other links are added to the uncertain edges.
  void unite_shared(SignedSets& sets) {
    std::vector<Link> order = shared_;
    std::stable_sort(order.begin(), order.end(),
                     [](const Link& x, const Link& y) { return x.confidence() > y.confidence(); });
    for (const Link& link : order) {
      if (std::abs(link.sum) > link.n / 2) {
        sets.unite(link.a, link.b, link.sum < 0);
      } else {
        doubtful_.push_back(link);
      }
    }
  }

  void unite_doubtful(SignedSets& sets) {
    std::vector<Link> links;
    for (const Link& link : doubtful_) {
      const SignedSets::Member a = sets.find(link.a), b = sets.find(link.b);
      if (a.set == b.set) continue;
      links.push_back(
          make_link(a.set, b.set, a.opposite == b.opposite ? link.sum : -link.sum, link.n));
    }
    merge(links);
    std::stable_sort(links.begin(), links.end(), [](const Link& x, const Link& y) {
      return std::abs(x.sum) > std::abs(y.sum);
    });
    for (const Link& link : links) sets.unite(link.a, link.b, link.sum < 0);
  }

  void turn_samples(const std::vector<std::uint32_t>& whole, std::size_t n_wholes,
                    std::size_t n_components, const Context& context) {
    const std::size_t n = samples_.size();
    sides_.trust.assign(n_pieces(), 0.0f);
    if (n == 0) return;
    std::vector<Vec3> points(n), normals(n);
    Patches patches{std::vector<double>(n), std::vector<double>(n)};
    OrientedParts parts{.piece = std::vector<std::uint32_t>(n),
                        .component = std::vector<std::uint32_t>(n)};
    // Numbers only the sets that have samples.
    const auto renumber = [n](const auto& of_sample, std::size_t n_sets, std::size_t& count) {
      constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
      std::vector<std::uint32_t> number(n_sets, kNone);
      count = 0;
      for (std::size_t s = 0; s < n; ++s) {
        std::uint32_t& own = number[of_sample(s)];
        if (own == kNone) own = static_cast<std::uint32_t>(count++);
      }
      return number;
    };
    const auto whole_of = [&](std::size_t s) { return whole[samples_[s].piece]; };
    const auto component_of = [&](std::size_t s) { return sides_.component[samples_[s].piece]; };
    const auto pieces = renumber(whole_of, n_wholes, parts.n_pieces);
    const auto components = renumber(component_of, n_components, parts.n_components);
    for (std::size_t s = 0; s < n; ++s) {
      const SideSample& sample = samples_[s];
      points[s] = sample.point;
      normals[s] = sides_.turned[sample.piece] != 0 ? -sample.normal : sample.normal;
      patches.areas[s] = sample.area, patches.spacing[s] = sample.spacing;
      parts.piece[s] = pieces[whole_of(s)];
      parts.component[s] = components[component_of(s)];
    }
    const std::vector<Vec3> before = normals;
    const SideTrust trust = turn_outwards(points, patches, parts, normals, context);
    sides_.doubtful = trust.doubtful;
    for (std::size_t s = 0; s < n; ++s) samples_[s].normal = normals[s];
    sides_.n_components = parts.n_components;
    std::vector<std::uint8_t> turned(n_wholes, 0);
    for (std::size_t s = 0; s < n; ++s) {
      if (dot(normals[s], before[s]) < 0) turned[whole_of(s)] = 1;
    }
    for (std::size_t i = 0; i < n_pieces(); ++i) {
      sides_.turned[i] ^= turned[whole[i]];
      const std::uint32_t component = components[sides_.component[i]];
      if (component < trust.of_component.size()) {
        sides_.trust[i] = static_cast<float>(trust.of_component[component]);
      }
    }
  }

  JoinedSides sides_;
  std::vector<SideSample> samples_;
  std::vector<Link> shared_, doubtful_;
};

}  // namespace

JoinedSides join_sides(const PieceStore& store, std::size_t n_tiles, const Context& context) {
  return Joining(store, n_tiles).join(context);
}

}  // namespace rholm
