#include "reconstruct/points/point_source.h"

#include <algorithm>
#include <utility>

#include "reconstruct/points/point_rows.h"
#include "rholm/error.h"
#include "rholm/point_stream.h"

namespace rholm {
namespace {

constexpr std::size_t kAtATime = std::size_t{1} << 14;  // points; chosen: they stay in the cache

class FileSource final : public PointSource {
 public:
  FileSource(std::filesystem::path path, const ShapeReadOptions& options)
      : path_(std::move(path)), options_(options) {
    rewind();
  }
  void rewind() override {
    if (!stream_ || stream_->read_so_far() > 0) {
      stream_ = std::make_unique<PointStream>(path_, options_);
    }
  }
  bool next(PointCloud& piece, const Context&) override { return stream_->read(kAtATime, piece); }
  std::optional<std::uint64_t> size() const override { return stream_->size(); }
  double part_read() const override { return stream_->part_read(); }
  std::uint64_t dropped() const override { return stream_->dropped(); }
  std::vector<std::string> warnings() const override { return stream_->warnings(); }

 private:
  std::filesystem::path path_;
  ShapeReadOptions options_;
  std::unique_ptr<PointStream> stream_;
};

// Reads a source once, and keeps what it has read: pairs of sections, a layout and rows.
class KeptSource final : public PointSource {
 public:
  KeptSource(std::unique_ptr<PointSource> source, PieceStore& store)
      : source_(std::move(source)), store_(store) {
    if (source_) appender_ = std::make_unique<PieceAppender>(store_, kGroup, 1, 0);
  }
  static bool is_kept(const PieceStore& store) { return store.has(kPiece); }

  void rewind() override {
    PointCloud rest;
    while (appender_ && begun_ && next(rest, {.threads = 1})) continue;
    section_ = 0;
  }
  bool next(PointCloud& piece, const Context& context) override {
    if (appender_) return read_on(piece, context);
    if (!reader_) reader_.emplace(store_.open(kPiece));
    piece = {};
    if (section_ + 2 > reader_->n_sections()) return false;
    const PointLayout layout = parse_layout(reader_->read(section_));
    piece = empty_cloud(layout);
    take_rows(layout, reader_->read(section_ + 1), piece);
    section_ += 2;
    return true;
  }
  std::optional<std::uint64_t> size() const override {
    return source_ ? source_->size() : std::nullopt;
  }
  double part_read() const override {
    if (appender_) return source_->part_read();
    if (!reader_ || section_ >= reader_->n_sections()) return section_ > 0 ? 1 : 0;
    return static_cast<double>(section_) / static_cast<double>(reader_->n_sections());
  }
  std::uint64_t dropped() const override { return source_ ? source_->dropped() : 0; }
  std::vector<std::string> warnings() const override {
    return source_ ? source_->warnings() : std::vector<std::string>{};
  }

 private:
  static constexpr const char* kGroup = "input";
  static constexpr const char* kPiece = "input/0";

  bool read_on(PointCloud& piece, const Context& context) {
    begun_ = true;
    if (!source_->next(piece, context)) {
      appender_->finish();
      appender_.reset();
      section_ = std::size_t(-1) / 2;  // at the end, until it is rewound
      return false;
    }
    const PointLayout layout = layout_of(piece);
    const std::size_t bytes = layout.row_bytes();
    std::vector<std::byte> rows(bytes * piece.points.size());
    for (std::size_t i = 0; i < piece.points.size(); ++i) {
      put_row(layout, piece, i, rows.data() + i * bytes);
    }
    appender_->append_section(0, layout_bytes(layout));
    appender_->append_section(0, rows);
    return true;
  }

  std::unique_ptr<PointSource> source_;  // none: all is kept already
  PieceStore& store_;
  std::unique_ptr<PieceAppender> appender_;  // until all is read
  std::optional<PieceReader> reader_;
  bool begun_ = false;
  std::size_t section_ = 0;
};

class MemorySource final : public PointSource {
 public:
  MemorySource(const PointCloud& cloud, std::uint64_t dropped) : cloud_(cloud), dropped_(dropped) {}
  MemorySource(PointCloud&& cloud, std::uint64_t dropped)
      : own_(std::move(cloud)), cloud_(own_), dropped_(dropped) {}
  void rewind() override { at_ = 0; }
  bool next(PointCloud& piece, const Context&) override {
    const std::size_t n = std::min(kAtATime, cloud_.points.size() - at_);
    const auto cut = [&](const auto& all, auto& part) {
      const auto from = all.begin() + static_cast<std::ptrdiff_t>(at_);
      part.assign(from, from + static_cast<std::ptrdiff_t>(n));
    };
    cut(cloud_.points, piece.points);
    piece.normals.clear();
    if (!cloud_.normals.empty()) cut(cloud_.normals, piece.normals);
    piece.attributes.resize(cloud_.attributes.size());
    for (std::size_t k = 0; k < piece.attributes.size(); ++k) {
      const Attribute& attribute = cloud_.attributes[k];
      piece.attributes[k].name = attribute.name;
      piece.attributes[k].type = attribute.type;
      cut(attribute.values, piece.attributes[k].values);
    }
    at_ += n;
    return n > 0;
  }
  std::optional<std::uint64_t> size() const override { return cloud_.points.size(); }
  double part_read() const override {
    if (cloud_.points.empty()) return 1;
    return static_cast<double>(at_) / static_cast<double>(cloud_.points.size());
  }
  std::uint64_t dropped() const override { return dropped_; }
  void finish() override { own_ = {}; }

 private:
  PointCloud own_;
  const PointCloud& cloud_;
  std::uint64_t dropped_;
  std::size_t at_ = 0;
};

}  // namespace

std::unique_ptr<PointSource> open_points(const std::filesystem::path& path,
                                         const ShapeReadOptions& options, PieceStore& store) {
  std::error_code error;
  const bool once = path == "-" || (std::filesystem::exists(path, error) &&
                                    !std::filesystem::is_regular_file(path, error));
  if (!once) return std::make_unique<FileSource>(path, options);
  if (KeptSource::is_kept(store)) return std::make_unique<KeptSource>(nullptr, store);
  return std::make_unique<KeptSource>(std::make_unique<FileSource>(path, options), store);
}

std::unique_ptr<PointSource> points_in_memory(const PointCloud& cloud, std::uint64_t dropped) {
  return std::make_unique<MemorySource>(cloud, dropped);
}

std::unique_ptr<PointSource> points_in_memory(PointCloud&& cloud, std::uint64_t dropped) {
  return std::make_unique<MemorySource>(std::move(cloud), dropped);
}

}  // namespace rholm
