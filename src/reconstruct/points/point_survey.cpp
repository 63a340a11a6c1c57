#include "reconstruct/points/point_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/refuse.h"
#include "reconstruct/points/point_sample.h"

namespace rholm {
namespace {

constexpr std::uint64_t kSamplesPerTile = 64;  // chosen: sizes of tiles differ by an eighth
// Size of the sample if there is one tile (chosen): only find_far_ball() needs it, which takes the
// 163rd place from either end along each axis.
constexpr std::uint64_t kSampleOfOnly = std::uint64_t{1} << 15;

// Counts, over the points that are finite and not far.
struct Tally {
  std::uint64_t points = 0, not_finite = 0, far = 0;
  Vec3 low, high;
  bool normals = false;

  Tally() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    low = {kInfinity, kInfinity, kInfinity};
    high = -low;
  }

  bool takes(const Vec3& p, const FarBall& ball) {
    if (!is_finite(p)) {
      ++not_finite;
      return false;
    }
    if (ball.is_far(p)) {
      ++far;
      return false;
    }
    ++points;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    return true;
  }
  void see(const Vec3& normal) { normals = normals || (is_finite(normal) && !(normal == Vec3{})); }
};

// Calls take(piece) for each piece of the source.
template <class Take>
void for_each_piece(PointSource& source, const Context& context, const Take& take) {
  PointCloud piece;
  source.rewind();
  while (source.next(piece, context)) {
    take(piece);
    ask_cancel();
    report_progress(context, "survey", source.part_read());
  }
}

std::uint64_t sample_size(std::uint64_t points, const SurveyOptions& options) {
  const std::uint64_t per_tile = std::max<std::uint64_t>(options.points_per_tile, 1);
  if (points <= per_tile) return std::min(kSampleOfOnly, options.least_sample);
  return std::max(options.least_sample, kSamplesPerTile * ((points + per_tile - 1) / per_tile));
}

// Returns true if some place of the box may be far.
bool reaches_beyond(const FarBall& ball, const Bounds& box) {
  const Vec3 a = ball.middle - box.min, b = box.max - ball.middle;
  return ball.is_far(ball.middle +
                     Vec3{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
}

// Section of the survey's piece whose size does not depend on the number of points.
struct SurveyHead {
  std::uint64_t points, not_finite, far_isolated, dropped;
  FarBall ball;
  Bounds bounds;
  double n_different;
};

}  // namespace

Survey survey(PointSource& source, const SurveyOptions& options, const Context& context) {
  Survey result;
  // If the number of points is known, the sample never has to grow. If it is not, there may be
  // several tiles.
  PointSample sample(sample_size(source.size().value_or(options.points_per_tile + 1), options));
  const auto count = [&](Tally& tally, const FarBall& ball, const PointCloud& piece, bool first) {
    for (std::size_t i = 0; i < piece.points.size(); ++i) {
      if (!tally.takes(piece.points[i], ball)) continue;
      if (first) sample.add(piece.points[i]);
      if (!piece.normals.empty()) tally.see(piece.normals[i]);
    }
  };
  Tally tally;
  bool any = false;
  for_each_piece(source, context, [&](const PointCloud& piece) {
    if (!any) {
      result.layout = layout_of(piece);
    } else {
      widen(result.layout, layout_of(piece));
    }
    any = true;
    count(tally, {}, piece, true);
    sample.grow(sample_size(tally.points, options));
  });
  if (tally.points == 0) {
    refuse(any ? "no point has finite coordinates" : "there are no points to make a surface of");
  }
  // The size follows from the points found: their number may not be known before.
  result.sample = sample.take(sample_size(tally.points, options));
  result.n_different = sample.n_different();
  result.bounds = {.min = tally.low, .max = tally.high};
  if (options.drop_far_isolated) result.ball = find_far_ball(result.sample);
  if (reaches_beyond(result.ball, result.bounds)) {
    tally = Tally();
    for_each_piece(source, context,
                   [&](const PointCloud& piece) { count(tally, result.ball, piece, false); });
    const std::size_t before = result.sample.size();
    std::erase_if(result.sample, [&](const Vec3& p) { return result.ball.is_far(p); });
    result.n_different *= static_cast<double>(result.sample.size()) / static_cast<double>(before);
    result.bounds = {.min = tally.low, .max = tally.high};
  }
  result.points = tally.points;
  result.not_finite = tally.not_finite;
  result.dropped = source.dropped();
  result.far_isolated = tally.far;
  result.layout.normals = tally.normals;
  return result;
}

void write_survey(const Survey& survey, PieceStore& store) {
  const SurveyHead head{.points = survey.points,
                        .not_finite = survey.not_finite,
                        .far_isolated = survey.far_isolated,
                        .dropped = survey.dropped,
                        .ball = survey.ball,
                        .bounds = survey.bounds,
                        .n_different = survey.n_different};
  const std::vector<std::byte> layout = layout_bytes(survey.layout);
  const std::span<const std::byte> sections[] = {bytes_of(std::span(&head, 1)), layout,
                                                 bytes_of(survey.sample)};
  store.write("survey", sections);
}

std::optional<Survey> read_survey(const PieceStore& store) {
  if (!store.has("survey")) return std::nullopt;
  const PieceReader piece = store.open("survey");
  if (piece.n_sections() != 3 || piece.size(0) != sizeof(SurveyHead)) {
    refuse("the survey of the points is another version's; begin the run anew");
  }
  const SurveyHead head = piece.values<SurveyHead>(0).front();
  return Survey{.points = head.points,
                .not_finite = head.not_finite,
                .far_isolated = head.far_isolated,
                .dropped = head.dropped,
                .ball = head.ball,
                .bounds = head.bounds,
                .layout = parse_layout(piece.read(1)),
                .n_different = head.n_different,
                .sample = piece.values<Vec3>(2)};
}

}  // namespace rholm
