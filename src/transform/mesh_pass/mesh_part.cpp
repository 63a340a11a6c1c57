#include "transform/mesh_pass/mesh_part.h"

#include <algorithm>
#include <span>

namespace rholm {
namespace {

// Visits the numbers that reading and writing have in the same order.
template <typename Part, typename Archive>
void visit_numbers(Part& part, Archive& archive) {
  archive.value(part.sums);
  archive.value(part.mean);
  archive.value(part.weight);
  archive.value(part.modulus);
  archive.value(part.nodes);
  archive.value(part.node_error2);
  archive.value(part.lumps);
  archive.value(part.border_weight);
  archive.value(part.border.per_vertex);
}

}  // namespace

template <typename T>
void write(const MeshPart<T>& part, ByteWriter& writer) {
  visit_numbers(part, writer);
  writer.array(std::span(part.half_edges));
  writer.array(std::span(part.block_errors));
  writer.array(std::span(part.border.vertices));
  writer.array(std::span(part.border.lumps));
  writer.value(part.undivided.degree());
  writer.array(part.undivided.values());
}

template <typename T>
MeshPart<T> read_part(ByteReader& reader) {
  MeshPart<T> part;
  visit_numbers(part, reader);
  reader.array(part.half_edges);
  reader.array(part.block_errors);
  reader.array(part.border.vertices);
  reader.array(part.border.lumps);
  if (part.border.lumps.size() != part.border.per_vertex * part.border.vertices.size()) {
    ByteReader::refuse();
  }
  int degree = 0;
  std::vector<double> values;
  reader.value(degree);
  reader.array(values);
  const auto orders = static_cast<std::size_t>(degree) + 1;
  if (degree < 0 || degree > kMaxDegree || values.size() != 2 * orders * orders) {
    ByteReader::refuse();
  }
  part.undivided = Coefficients(degree);
  std::copy(values.begin(), values.end(), part.undivided.values().begin());
  return part;
}

template void write(const MeshPart<float>&, ByteWriter&);
template void write(const MeshPart<double>&, ByteWriter&);
template MeshPart<float> read_part(ByteReader&);
template MeshPart<double> read_part(ByteReader&);

}  // namespace rholm
