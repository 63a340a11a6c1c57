#include "rholm/mapped_mesh.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "io/ply/mapped_rows.h"
#include "io/ply/ply_header.h"
#include "io/shapes/shape_source.h"
#include "rholm/large_mesh.h"

namespace rholm {
namespace {

// Maps a regular file; returns an empty span if it is empty or no regular file.
std::span<std::byte> map_file(const std::filesystem::path& path) {
  // A pipe is not even opened: its writer would see a reader come and go.
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return {};
  void* map = MAP_FAILED;
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
    map =
        ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, file, 0);
  }
  ::close(file);
  if (map == MAP_FAILED) return {};
  return {static_cast<std::byte*>(map), static_cast<std::size_t>(status.st_size)};
}

struct VertexRow {
  std::size_t x = 0;  // the index of the property x
  ScalarType coordinate = ScalarType::kFloat64;
  std::size_t offset = 0;  // bytes before x
  std::size_t stride = 0;
};

std::optional<VertexRow> row_of(const PlyElement& vertex) {
  const std::size_t x = find_property(vertex, "x");
  if (x == kNoProperty || find_property(vertex, "y") != x + 1 ||
      find_property(vertex, "z") != x + 2) {
    return {};
  }
  VertexRow row{.x = x, .coordinate = vertex.properties[x].type};
  if (row.coordinate != ScalarType::kFloat32 && row.coordinate != ScalarType::kFloat64) return {};
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    const PlyProperty& property = vertex.properties[i];
    const bool is_coordinate = i >= x && i < x + 3;
    if (property.is_list || (is_coordinate && property.type != row.coordinate)) return {};
    if (i < x) row.offset += size_of(property.type);
    row.stride += size_of(property.type);
  }
  return row;
}

// Returns the properties beside the coordinates, for rows that begin at `first`.
std::vector<MappedScalar> scalars_of(const PlyElement& vertex, const VertexRow& row,
                                     const std::byte* first) {
  std::vector<MappedScalar> scalars;
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    const PlyProperty& property = vertex.properties[i];
    if (i < row.x || i >= row.x + 3) {
      scalars.push_back({property.name, property.type, first, row.stride});
    }
    first += size_of(property.type);
  }
  return scalars;
}

bool is_plain_list(const PlyElement& face) {
  if (face.properties.size() != 1) return false;
  const PlyProperty& list = face.properties[0];
  return list.is_list && size_of(list.count_type) == 1 &&
         (list.type == ScalarType::kInt32 || list.type == ScalarType::kUint32) &&
         (list.name == "vertex_indices" || list.name == "vertex_index");
}

struct Rows {
  MeshView view;
  std::vector<MappedScalar> scalars;
  std::uint64_t n_faces = 0;
  std::size_t face_bytes = 0;
};

// Describes the content of the bytes if it can be used in place.
std::optional<Rows> rows_in(const ShapeSource& source) {
  if (!looks_like_ply(source.bytes)) return {};
  const PlyHeader header = parse_ply_header(source);
  const PlyEncoding native = std::endian::native == std::endian::little ? PlyEncoding::kLittleEndian
                                                                        : PlyEncoding::kBigEndian;
  if (header.encoding != native || header.elements.size() != 2) return {};
  const PlyElement &vertex = header.elements[0], &face = header.elements[1];
  if (vertex.name != "vertex" || face.name != "face" || !is_plain_list(face)) return {};
  const std::optional<VertexRow> row = row_of(vertex);
  if (!row || vertex.count == 0 || vertex.count > std::numeric_limits<std::uint32_t>::max()) {
    return {};
  }
  // Counts in the header may be wrong: the size must match to the byte.
  const std::uint64_t left = source.bytes.size() - header.body;
  if (vertex.count > left / row->stride) return {};
  if (face.count == 0) return {};
  const auto* body = reinterpret_cast<const std::byte*>(source.bytes.data()) + header.body;
  return Rows{.view = {.vertices = body + row->offset,
                       .n_vertices = vertex.count,
                       .vertex_stride = row->stride,
                       .coordinate = row->coordinate,
                       .faces = body + vertex.count * row->stride + 1,
                       .n_faces = 0,
                       .face_stride = kFaceBytes},
              .scalars = scalars_of(vertex, *row, body),
              .n_faces = face.count,
              .face_bytes = left - vertex.count * row->stride};
}

// After 16 faces, lengths are at the same positions of 16-byte vectors again. Whole vectors of
// bytes are compared, and the mask selects the lengths.
constexpr std::size_t kRound = 16;
constexpr auto kLengths = [] {
  std::array<std::uint8_t, kRound * kFaceBytes> mask{};
  for (std::size_t i = 0; i < kRound; ++i) mask[i * kFaceBytes] = 0xff;
  return mask;
}();

}  // namespace

MappedMesh& MappedMesh::operator=(MappedMesh&& other) noexcept {
  std::swap(map_, other.map_);
  std::swap(size_, other.size_);
  std::swap(view_, other.view_);
  std::swap(scalars_, other.scalars_);
  return *this;
}

MappedMesh::~MappedMesh() {
  if (map_ != nullptr) ::munmap(map_, size_);
}

bool MappedMesh::counts_are_three(std::size_t first, std::size_t n) const {
  const auto* at = reinterpret_cast<const std::uint8_t*>(view_.faces) - 1 + first * kFaceBytes;
  unsigned bad = 0;
  for (; n >= kRound; n -= kRound, at += kRound * kFaceBytes) {
    std::uint8_t different = 0;
    for (std::size_t i = 0; i < kLengths.size(); ++i) {
      different = static_cast<std::uint8_t>(different | ((at[i] ^ 3) & kLengths[i]));
    }
    bad |= different;
  }
  for (; n > 0; --n, at += kFaceBytes) bad |= *at ^ 3u;
  return bad == 0;
}

void MappedMesh::release(std::size_t first, std::size_t n) const {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const auto faces = static_cast<std::size_t>(view_.faces - static_cast<std::byte*>(map_)) - 1;
  // Releases whole pages. The first page is included, because all data before `first` are done. The
  // last page is included only if it ends the file.
  const std::size_t begin = (faces + first * kFaceBytes) / page * page;
  const std::size_t end = faces + (first + n) * kFaceBytes;
  const std::size_t last = end == size_ ? end : end / page * page;
  // The system may ignore this advice without harm.
  if (last > begin) ::madvise(static_cast<std::byte*>(map_) + begin, last - begin, MADV_DONTNEED);
}

void release_vertices(const MappedMesh& mesh, std::size_t first, std::size_t n) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const MeshView& view = mesh.view();
  // Releases whole pages, as above; the bytes after the vertices belong to the file, too.
  const auto page_of = [&](std::size_t vertex) {
    const std::byte* const at = view.vertices + vertex * view.vertex_stride;
    return const_cast<std::byte*>(at - reinterpret_cast<std::uintptr_t>(at) % page);
  };
  std::byte* const begin = page_of(first);
  std::byte* const end = page_of(first + n);
  if (end > begin) ::madvise(begin, static_cast<std::size_t>(end - begin), MADV_DONTNEED);
}

std::optional<MappedRows> map_rows(const std::filesystem::path& path, const Context& context) {
  if (path == "-") return {};
  const std::span<std::byte> bytes = map_file(path);
  if (bytes.empty()) return {};
  MappedMesh mesh(bytes.data(), bytes.size());
  const ShapeSource source({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                           path.string(), {}, context, 0);
  std::optional<Rows> rows = rows_in(source);
  if (!rows) return {};
  mesh.view_ = rows->view;
  mesh.scalars_ = std::move(rows->scalars);
  return MappedRows{
      .mesh = std::move(mesh), .n_faces = rows->n_faces, .face_bytes = rows->face_bytes};
}

std::optional<MappedMesh> map_mesh(const std::filesystem::path& path, const Context& context) {
  std::optional<MappedRows> rows = map_rows(path, context);
  if (!rows) return {};
  const bool fits =
      rows->face_bytes % kFaceBytes == 0 && rows->face_bytes / kFaceBytes == rows->n_faces;
  if (!fits) return {};
  rows->mesh.view_.n_faces = rows->n_faces;
  return std::move(rows->mesh);
}

}  // namespace rholm
