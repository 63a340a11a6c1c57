#include "io/ply/mapped_polygons.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "io/ply/mapped_rows.h"
#include "rholm/polygon.h"

namespace rholm {
namespace {

constexpr std::size_t kMostCorners = 255;  // the length is a byte

// The corners of a face.
struct Corners {
  std::array<std::uint32_t, kMostCorners> index;
  std::size_t n = 0;

  std::span<const std::uint32_t> all() const { return std::span(index).first(n); }
};

std::size_t bytes_of(std::size_t corners) { return 1 + 4 * corners; }

void take(const std::byte* face, Corners& corners) {
  corners.n = std::to_integer<std::size_t>(*face);
  std::memcpy(corners.index.data(), face + 1, 4 * corners.n);
}

// Removes corners of polygons that are equal to the corner before, as FaceList does.
void clean(Corners& corners) {
  if (corners.n <= 3) return;
  const auto begin = corners.index.begin();
  auto end = std::unique(begin, begin + static_cast<std::ptrdiff_t>(corners.n));
  while (end > begin + 1 && *(end - 1) == *begin) --end;
  corners.n = static_cast<std::size_t>(end - begin);
}

// Triangulates polygons one at a time, with the positions of their own corners only.
class Cutter {
 public:
  explicit Cutter(const MeshView& mesh) : mesh_(mesh) {}

  void visit(const Corners& corners, const std::function<void(const Triangle&)>& visit) {
    places_.clear();
    numbers_.clear();
    triangles_.clear();
    for (const std::uint32_t corner : corners.all()) {
      numbers_.push_back(static_cast<std::uint32_t>(places_.size()));
      places_.push_back(mesh_.vertex(corner));
    }
    triangulate_polygon(places_, numbers_, triangles_);
    for (const auto& [a, b, c] : triangles_) {
      visit({corners.index[a], corners.index[b], corners.index[c]});
    }
  }

 private:
  const MeshView& mesh_;
  std::vector<Vec3> places_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Triangle> triangles_;
};

// Releases faces in blocks after they have been visited.
class FaceRelease {
 public:
  explicit FaceRelease(const MappedMesh& mesh) : mesh_(mesh) {}
  void passed(std::size_t bytes) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    if (bytes - done_ < kBlock) return;
    mesh_.release(done_ / kFaceBytes, (bytes - done_) / kFaceBytes);
    done_ = bytes;
  }

 private:
  const MappedMesh& mesh_;
  std::size_t done_ = 0;
};

}  // namespace

// Returns true if the faces fill the bytes and their indices are in range.
bool MappedPolygons::survey(std::size_t bytes) {
  const MeshView& view = vertices_.view();
  const std::byte* const faces = view.faces - 1;
  Corners corners;
  FaceRelease release(vertices_);
  CancelPoll poll;
  std::size_t at = 0;
  for (std::uint64_t face = 0; face < n_faces_; ++face) {
    poll();
    if (at == bytes) return false;
    const std::size_t size = bytes_of(std::to_integer<std::size_t>(faces[at]));
    if (size > bytes - at) return false;
    take(faces + at, corners);
    for (const std::uint32_t corner : corners.all()) {
      if (corner >= view.n_vertices) return false;
    }
    clean(corners);
    corners.n < 3 ? ++skipped_ : n_triangles_ += corners.n - 2;
    at += size;
    release.passed(at);
  }
  return at == bytes;
}

void MappedPolygons::visit(const std::function<void(const Triangle&)>& visit) const {
  const std::byte* const faces = vertices_.view().faces - 1;
  Corners corners;
  Cutter cutter(vertices_.view());
  FaceRelease release(vertices_);
  std::size_t at = 0;
  for (std::uint64_t face = 0; face < n_faces_; ++face) {
    take(faces + at, corners);
    at += bytes_of(corners.n);
    clean(corners);
    if (corners.n == 3) {
      visit({corners.index[0], corners.index[1], corners.index[2]});
    } else if (corners.n > 3) {
      cutter.visit(corners, visit);
    }
    release.passed(at);
  }
}

std::optional<MappedPolygons> map_polygons(const std::filesystem::path& path,
                                           const Context& context) {
  std::optional<MappedRows> rows = map_rows(path, context);
  if (!rows) return {};
  MappedPolygons polygons(std::move(rows->mesh), rows->n_faces);
  if (!polygons.survey(rows->face_bytes)) return {};
  return polygons;
}

}  // namespace rholm
