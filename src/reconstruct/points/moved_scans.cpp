#include "reconstruct/points/moved_scans.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/refuse.h"
#include "reconstruct/points/point_sample.h"
#include "shape/points/isolated_points.h"
#include "shape/points/scan_poses.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

constexpr const char* kPiece = "scans";

struct Row {
  std::uint64_t hash = 0;
  Vec3 point, normal, sensor;
  double scan = 0;

  auto key() const {
    return std::tie(hash, scan, normal.x, normal.y, normal.z, sensor.x, sensor.y, sensor.z);
  }
};

// The points with the smallest hashes of their places.
class ScanSample {
 public:
  explicit ScanSample(std::size_t most) : most_(most) {}

  // False if the values of the attribute are no numbers of scans.
  bool add(const PointCloud& piece) {
    const Attribute* const scan = find_attribute(piece.attributes, "scan");
    if (scan == nullptr || !add_scans(scan->values, labels_)) return false;
    const std::vector<Vec3> sensors = sensors_of(piece);
    have_sensors_ = have_sensors_ && !sensors.empty();
    for (std::size_t i = 0; i < piece.points.size(); ++i) {
      const Vec3& p = piece.points[i];
      if (!is_finite(p)) continue;
      Row row{
          .hash = place_hash(p), .point = p, .normal = {}, .sensor = {}, .scan = scan->values[i]};
      if (!piece.normals.empty() && is_finite(piece.normals[i])) row.normal = piece.normals[i];
      if (!sensors.empty()) row.sensor = sensors[i];
      have_normals_ = have_normals_ || norm(row.normal) > 0;
      rows_.push_back(row);
    }
    if (rows_.size() > 2 * most_) trim();
    return true;
  }
  std::size_t n_scans() const { return labels_.size(); }

  PointCloud take(const ReconstructOptions& options) {
    trim();
    std::sort(rows_.begin(), rows_.end(), comes_before);
    std::vector<Vec3> places;
    places.reserve(rows_.size());
    for (const Row& row : rows_) places.push_back(row.point);
    const FarBall ball = options.keep_outliers ? FarBall{} : find_far_ball(places);
    PointCloud cloud;
    std::vector<Vec3> sensors;
    Attribute scan{"scan", ScalarType::kInt32, {}};
    for (const Row& row : rows_) {
      if (ball.is_far(row.point)) continue;
      if (have_normals_ && !(norm(row.normal) > 0)) continue;
      cloud.points.push_back(row.point);
      if (have_normals_) cloud.normals.push_back(row.normal);
      scan.values.push_back(row.scan);
      sensors.push_back(options.sensor.value_or(row.sensor));
    }
    cloud.attributes.push_back(std::move(scan));
    if (have_sensors_ || options.sensor) {
      for (const char* axis : kSensorAxes) {
        cloud.attributes.push_back(
            {axis, ScalarType::kFloat64, std::vector<double>(cloud.points.size())});
      }
      set_sensors(cloud, sensors);
    }
    return cloud;
  }

 private:
  static bool comes_before(const Row& a, const Row& b) { return a.key() < b.key(); }
  void trim() {
    if (rows_.size() <= most_) return;
    std::nth_element(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(most_), rows_.end(),
                     comes_before);
    rows_.resize(most_);
  }

  std::size_t most_;
  std::vector<Row> rows_;
  std::vector<double> labels_;
  bool have_normals_ = false, have_sensors_ = true;
};

ScanPoses poses_of(PointSource& source, const ReconstructOptions& options, const Context& context) {
  ScanSample sample(options.tile_points);
  PointCloud piece;
  source.rewind();
  while (source.next(piece, context)) {
    if (!sample.add(piece)) return {};
    ask_cancel();
    report_progress(context, "scans", source.part_read());
  }
  ScanPoses poses;
  if (sample.n_scans() > 1) {
    PointCloud some = sample.take(options);
    poses = find_scan_poses(some, context);
    const auto n = static_cast<double>(some.points.size());
    if (!poses.poses.empty()) poses.alignment.moved = std::sqrt(poses.move(some) / n);
  }
  poses.alignment.scans = sample.n_scans();
  return poses;
}

void write_poses(const ScanPoses& poses, PieceStore& store) {
  const std::span<const std::byte> sections[] = {bytes_of(std::span(&poses.alignment, 1)),
                                                 bytes_of(std::span(&poses.middle, 1)),
                                                 bytes_of(poses.labels), bytes_of(poses.poses)};
  store.write(kPiece, sections);
}

ScanPoses read_poses(const PieceStore& store) {
  const PieceReader piece = store.open(kPiece);
  const auto alignment = piece.values<ScanAlignment>(0);
  const auto middle = piece.values<Vec3>(1);
  ScanPoses poses;
  poses.labels = piece.values<double>(2), poses.poses = piece.values<ScanPose>(3);
  if (alignment.size() != 1 || middle.size() != 1 ||
      !(poses.poses.empty() || poses.poses.size() == poses.labels.size())) {
    refuse("a piece with motions of scans does not fit; begin the run anew");
  }
  poses.alignment = alignment.front(), poses.middle = middle.front();
  return poses;
}

class MovedScans final : public PointSource {
 public:
  MovedScans(std::unique_ptr<PointSource> source, ScanPoses poses)
      : source_(std::move(source)), poses_(std::move(poses)) {}
  void rewind() override { source_->rewind(); }
  bool next(PointCloud& piece, const Context& context) override {
    if (!source_->next(piece, context)) return false;
    poses_.move(piece);
    return true;
  }
  std::optional<std::uint64_t> size() const override { return source_->size(); }
  double part_read() const override { return source_->part_read(); }
  std::uint64_t dropped() const override { return source_->dropped(); }
  std::vector<std::string> warnings() const override { return source_->warnings(); }
  void finish() override { source_->finish(); }

 private:
  std::unique_ptr<PointSource> source_;
  ScanPoses poses_;
};

}  // namespace

std::unique_ptr<PointSource> with_moved_scans(std::unique_ptr<PointSource> source,
                                              PieceStore& store, const ReconstructOptions& options,
                                              ScanAlignment& alignment, const Context& context) {
  if (options.keep_scans) return source;
  ScanPoses poses;
  if (store.has(kPiece)) {
    poses = read_poses(store);
  } else {
    poses = poses_of(*source, options, context);
    source->rewind();
    if (poses.alignment.scans > 0) write_poses(poses, store);
  }
  alignment = poses.alignment;
  if (poses.poses.empty()) return source;
  return std::make_unique<MovedScans>(std::move(source), std::move(poses));
}

}  // namespace rholm
