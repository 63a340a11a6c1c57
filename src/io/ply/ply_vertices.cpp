#include "io/ply/ply_vertices.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// 1024 positions have 24 kB and stay in the first-level cache together with their bytes. With many
// properties the blocks are smaller, so that they never exceed 512 kB in total.
std::size_t rows_per_block(std::size_t n_properties) {
  constexpr std::size_t kMostRows = 1024;
  constexpr std::size_t kMostValues = 65536;
  return std::clamp<std::size_t>(kMostValues / std::max<std::size_t>(n_properties, 1), 1,
                                 kMostRows);
}

void append(std::vector<Vec3>& all, const std::vector<Vec3>& block, std::size_t rows) {
  all.insert(all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(rows));
}

}  // namespace

PlyVertices::PlyVertices(const ShapeSource& source, const PlyElement& element, bool points)
    : source_(source),
      points_(points),
      block_rows_(rows_per_block(element.properties.size())),
      slots_(element.properties.size()) {
  if (!claim_vector(element, {"x", "y", "z"}, position_block_)) {
    source.fail("element 'vertex' has no properties x, y, z");
  }
  if (points) claim_vector(element, {"nx", "ny", "nz"}, normal_block_);
  std::size_t lists = 0;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.is_list) ++lists;
    if (property.is_list || slots_[i].first != nullptr || !source.attributes) continue;
    attributes.push_back({.name = property.name, .type = property.type, .values = {}});
    attribute_blocks_.emplace_back(block_rows_);
    slots_[i] = {.first = attribute_blocks_.back().data(), .stride = 1};
  }
  if (lists > 0) {
    warnings.push_back(counted(lists, "list property", "list properties") +
                       " of the vertices passed over");
  }
}

// Claims the three scalar properties of these names, if all exist, as a vector per row.
bool PlyVertices::claim_vector(const PlyElement& element, const char* const (&names)[3],
                               std::vector<Vec3>& block) {
  std::size_t places[3];
  for (int k = 0; k < 3; ++k) {
    places[k] = find_property(element, names[k]);
    if (places[k] == kNoProperty || element.properties[places[k]].is_list) return false;
  }
  block.resize(block_rows_);
  slots_[places[0]] = {.first = &block[0].x, .stride = 3};
  slots_[places[1]] = {.first = &block[0].y, .stride = 3};
  slots_[places[2]] = {.first = &block[0].z, .stride = 3};
  return true;
}

void PlyVertices::reserve(std::size_t rows) {
  positions.reserve(rows);
  if (!normal_block_.empty()) normals.reserve(rows);
  for (Attribute& attribute : attributes) attribute.values.reserve(rows);
}

void PlyVertices::append_block(std::size_t rows) {
  const std::size_t before = source_.rows_before + positions.size();
  append(positions, position_block_, rows);
  if (!normal_block_.empty()) append(normals, normal_block_, rows);
  // Points that are not finite are dropped after all have been read.
  if (!points_) {
    check_finite(source_, std::span(position_block_).first(rows), before, "vertex", "coordinate");
  }
  for (std::size_t k = 0; k < attributes.size(); ++k) {
    const std::vector<double>& block = attribute_blocks_[k];
    attributes[k].values.insert(attributes[k].values.end(), block.begin(),
                                block.begin() + static_cast<std::ptrdiff_t>(rows));
  }
}

}  // namespace rholm
