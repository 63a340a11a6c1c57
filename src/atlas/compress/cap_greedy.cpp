#include "atlas/compress/cap_greedy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"

namespace rholm {
namespace {

constexpr double kLadder = 1.3;     // ratio of supports (method 7.8)
constexpr std::size_t kBatch = 12;  // seeds per batch, each with its own memory
// Number of seeds at first, and after each cap. Results scatter by 4 % with the seeds
// (scripts/constants). With 12 after each cap they are 2 % smaller on average, for a quarter more
// time.
constexpr std::size_t kFirstSeeds = 256, kMoreSeeds = 6;
// Number of caps from which the total is estimated.
constexpr std::size_t kTelling = 20;
constexpr double kHalfAngles[] = {30 * std::numbers::pi / 180, 15 * std::numbers::pi / 180};

struct Entry {
  Candidate candidate;
  std::uint32_t seed = 0;
  double gain = 0;  // number of samples, when last counted
  double value() const { return gain / static_cast<double>(candidate.cost()); }
};

class Greedy {
 public:
  Greedy(const SampleLevels& samples, double diagonal, const GreedyOptions& options,
         std::vector<std::uint8_t> covered, const Context& context)
      : samples_(samples), options_(options), context_(context) {
    cover_.is_covered = std::move(covered);
    left_ = static_cast<std::size_t>(
        std::count(cover_.is_covered.begin(), cover_.is_covered.end(), std::uint8_t{0}));
    open_ = left_;
    for (double r = options.largest * diagonal; r > options.smallest * diagonal; r /= kLadder) {
      radii_.push_back(r);
    }
  }

  GreedyCover run() {
    add_candidates(kFirstSeeds);
    std::size_t dry = 0;
    while (share_left() > options_.uncovered) {
      report_progress(context_, "caps",
                      std::min(0.99, std::log(share_left()) / std::log(options_.uncovered)));
      if (!accept()) {
        if (++dry > 20) break;
      } else {
        dry = 0;
        if (too_many()) break;
      }
      add_candidates(kMoreSeeds);
    }
    cover_.uncovered = share_left();
    return std::move(cover_);
  }

 private:
  double share_left() const {
    return static_cast<double>(left_) / static_cast<double>(samples_.size());
  }

  // Returns true, and sets cover_.foreseen, if all caps will take more numbers than
  // allowed. The estimate takes the chosen caps and, after kTelling caps, the same
  // cost for each open sample. Costly samples come last, so the estimate is too low.
  bool too_many() {
    if (options_.most_numbers == 0) return false;
    double foreseen = static_cast<double>(numbers_);
    if (cover_.chosen.size() >= kTelling) {
      foreseen *= static_cast<double>(open_) / static_cast<double>(open_ - left_);
    }
    if (foreseen <= static_cast<double>(options_.most_numbers)) return false;
    cover_.foreseen = static_cast<std::size_t>(foreseen);
    return true;
  }

  // Tries larger supports from the middle of the ladder while good, or smaller ones until good.
  void climb(std::uint32_t seed, CandidateScratch& scratch, std::vector<Entry>& found) const {
    const auto try_radius = [&](std::size_t r) {
      bool any = false;
      Entry best;
      const CandidatePlace place =
          candidate_place(samples_, seed, radii_[r], options_.candidate, scratch);
      for (const double half_angle : kHalfAngles) {
        Entry entry;
        const Rival rival{cover_.is_covered, any ? best.value() : 0};
        if (!make_candidate(samples_, place, half_angle, options_.candidate, rival, scratch,
                            entry.candidate)) {
          continue;
        }
        entry.seed = seed;
        entry.gain = gain_of(entry.candidate, cover_.is_covered);
        if (!any || entry.value() > best.value()) best = std::move(entry);
        any = true;
      }
      if (any) found.push_back(std::move(best));
      return any;
    };
    const std::size_t middle = std::min(start_, radii_.size() - 1);
    if (try_radius(middle)) {
      for (std::size_t r = middle; r-- > 0;) {
        if (!try_radius(r)) break;
      }
    } else {
      for (std::size_t r = middle + 1; r < radii_.size(); ++r) {
        if (try_radius(r)) break;
      }
    }
  }

  void add_candidates(std::size_t n) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < samples_.size(); ++i) {
      if (cover_.is_covered[i] == 0) open.push_back(i);
    }
    if (open.empty()) return;
    std::vector<std::uint32_t> seeds(n);
    for (std::uint32_t& seed : seeds) {
      seed = open[static_cast<std::size_t>(random_uniform(options_.seed, drawn_++) *
                                           static_cast<double>(open.size()))];
    }
    std::vector<std::vector<Entry>> found(n);
    for (std::size_t first = 0; first < n; first += kBatch) {
      parallel_for(std::min(kBatch, n - first), 1, context_, {},
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = begin; i < end; ++i) {
                       climb(seeds[first + i], scratches_[i], found[first + i]);
                     }
                   });
    }
    for (auto& entries : found) {
      for (Entry& entry : entries) pool_.push_back(std::move(entry));
    }
  }

  // Takes the best of the pool. Gains only fall, so a recounted best is the true best.
  bool accept() {
    const auto worse = [](const Entry& a, const Entry& b) { return a.value() < b.value(); };
    std::make_heap(pool_.begin(), pool_.end(), worse);
    while (!pool_.empty()) {
      std::pop_heap(pool_.begin(), pool_.end(), worse);
      Entry entry = std::move(pool_.back());
      pool_.pop_back();
      const double gain = gain_of(entry.candidate, cover_.is_covered);
      if (gain < 1) continue;
      if (gain < entry.gain) {
        entry.gain = gain;
        pool_.push_back(std::move(entry));
        std::push_heap(pool_.begin(), pool_.end(), worse);
        continue;
      }
      if (strays(samples_, entry.candidate.cap, entry.candidate.coefficients,
                 options_.candidate.stray, options_.candidate.stray, scratch_)) {
        continue;  // this check uses more probes
      }
      take(std::move(entry));
      return true;
    }
    return false;
  }

  void take(Entry entry) {
    const auto covered =
        covered_by(samples_, entry.candidate, entry.seed, options_.candidate.tolerance, scratch_);
    for (const std::uint32_t i : covered) {
      left_ -= cover_.is_covered[i] == 0;
      cover_.is_covered[i] = 1;
    }
    cover_.is_covered[entry.seed] = 1;
    const double radius = entry.candidate.cap.frame.support;
    std::size_t r = 0;
    while (r + 1 < radii_.size() && radii_[r + 1] > 0.99 * radius) ++r;
    start_ = r;
    numbers_ += entry.candidate.cost();
    cover_.chosen.push_back(std::move(entry.candidate));
    cover_.seeds.push_back(entry.seed);
  }

  const SampleLevels& samples_;
  const GreedyOptions& options_;
  const Context& context_;
  GreedyCover cover_;
  std::vector<double> radii_;        // supports in descending order
  std::size_t start_ = 3;            // index where climbs begin
  std::size_t open_ = 0, left_ = 0;  // number of uncovered samples, at first and now
  std::size_t numbers_ = 0;          // numbers of the chosen caps
  std::uint64_t drawn_ = 0;
  std::vector<Entry> pool_;
  CandidateScratch scratch_;
  std::vector<CandidateScratch> scratches_{kBatch};
};

}  // namespace

GreedyCover greedy_cover(const SampleLevels& samples, double diagonal, const GreedyOptions& options,
                         std::vector<std::uint8_t> covered, const Context& context) {
  return Greedy(samples, diagonal, options, std::move(covered), context).run();
}

}  // namespace rholm
