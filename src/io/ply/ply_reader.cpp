// PLY: reads one element of vertices and one of faces (or triangle strips); ignores others.
#include <algorithm>
#include <limits>

#include "base/plain_text.h"
#include "io/ply/ply_body.h"
#include "io/ply/ply_header.h"
#include "io/ply/ply_vertices.h"
#include "io/shapes/shape_source.h"

namespace rholm {

void PlyFaces::fail_index(std::uint64_t face, std::int64_t index) const {
  source_.fail("face " + std::to_string(face) + " names vertex " + std::to_string(index) +
               ", but the " + std::to_string(n_vertices_) + " vertices are numbered from 0");
}

void PlyFaces::add_to_strip(std::int64_t index) {
  if (index == -1) return end_strip();
  if (static_cast<std::uint64_t>(index) >= n_vertices_) {
    source_.fail("a triangle strip names vertex " + std::to_string(index) + ", but the " +
                 std::to_string(n_vertices_) + " vertices are numbered from 0");
  }
  const auto corner = static_cast<std::uint32_t>(index);
  const auto [a, b] = strip_;
  if (strip_length_ >= 2 && a != b && b != corner && a != corner) {
    const bool turned = strip_length_ % 2 == 1;
    list.add_triangle(turned ? Triangle{b, a, corner} : Triangle{a, b, corner});
  }
  strip_[0] = b;
  strip_[1] = corner;
  ++strip_length_;
}

namespace {

// Returns the index of the list of corners in an element of faces; throws if there is none.
std::size_t find_corner_list(const ShapeSource& source, const PlyElement& element) {
  for (const char* name : {"vertex_indices", "vertex_index"}) {
    const std::size_t place = find_property(element, name);
    if (place == kNoProperty) continue;
    const PlyProperty& property = element.properties[place];
    const bool integer =
        property.type != ScalarType::kFloat32 && property.type != ScalarType::kFloat64;
    if (property.is_list && integer) return place;
  }
  source.fail("element " + in_quotes(element.name) +
              " has no list of integers vertex_indices or vertex_index");
}

bool has_rows(const PlyHeader& header, const char* name) {
  const PlyElement* element = find_element(header, name);
  return element != nullptr && element->count > 0;
}

void note_passed_over(const PlyElement& element, std::vector<std::string>& warnings) {
  if (element.count == 0) return;
  const bool faces = element.name == "face" || element.name == "tristrips";
  if (!faces) {
    warnings.push_back(passed_over_warning(element));
  } else if (element.properties.size() > 1) {
    warnings.push_back(counted(element.properties.size() - 1, "property", "properties") +
                       " of element " + in_quotes(element.name) + " passed over");
  }
}

template <class Body>
ShapeFile read_body(const ShapeSource& source, const PlyHeader& header) {
  const PlyElement* vertex = find_element(header, "vertex");
  if (vertex == nullptr || vertex->count == 0) source.fail("has no vertices");
  if (vertex->count > std::numeric_limits<std::uint32_t>::max()) {
    source.fail("has " + std::to_string(vertex->count) + " vertices, the limit is 4294967295");
  }
  const bool has_faces = has_rows(header, "face") || has_rows(header, "tristrips");
  PlyVertices vertices(source, *vertex, !has_faces);
  PlyFaces faces(source, vertex->count);
  std::vector<std::string> warnings;
  Body body(source, header);
  for (const PlyElement& element : header.elements) {
    if (&element == vertex) {
      body.read_vertices(element, vertices);
      continue;
    }
    if (element.count > 0 && element.name == "face") {
      body.read_faces(element, find_corner_list(source, element), faces);
    } else if (element.count > 0 && element.name == "tristrips") {
      body.read_strips(element, find_corner_list(source, element), faces);
    } else {
      body.skip(element);
    }
    note_passed_over(element, warnings);
  }
  if (const std::size_t left = body.left(); left > 0) {
    warnings.push_back(counted(left, "byte", "bytes") + " after the last element passed over");
  }
  warnings.insert(warnings.end(), vertices.warnings.begin(), vertices.warnings.end());
  if (header.encoding == PlyEncoding::kAscii) {
    settle_attribute_types(vertices.attributes, warnings);
  }

  ShapeFile file;
  file.format = ShapeFormat::kPly;
  if (has_faces) {
    std::vector<Triangle> triangles = faces.list.finish(vertices.positions, warnings);
    file.shape = Mesh{.vertices = std::move(vertices.positions),
                      .faces = std::move(triangles),
                      .attributes = std::move(vertices.attributes)};
  } else {
    file.shape = PointCloud{.points = std::move(vertices.positions),
                            .normals = std::move(vertices.normals),
                            .attributes = std::move(vertices.attributes)};
  }
  file.warnings = std::move(warnings);
  return file;
}

}  // namespace

ShapeFile read_ply(const ShapeSource& source) {
  const PlyHeader header = parse_ply_header(source);
  if (header.encoding == PlyEncoding::kAscii) {
    ShapeFile file = read_body<PlyTextBody>(source, header);
    file.encoding = "ascii";
    return file;
  }
  ShapeFile file = read_body<PlyBinaryBody>(source, header);
  file.encoding =
      header.encoding == PlyEncoding::kLittleEndian ? "binary little endian" : "binary big endian";
  return file;
}

}  // namespace rholm
