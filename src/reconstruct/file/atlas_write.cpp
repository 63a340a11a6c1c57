// Writes the model file of an atlas. Layout: docs/model-file.md.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/file/atomic_file.h"
#include "io/hdf5/hdf5_writer.h"
#include "reconstruct/file/atlas_crc32.h"
#include "reconstruct/file/atlas_pack.h"
#include "reconstruct/file/atlas_rules.h"
#include "reconstruct/file/model_file.h"
#include "rholm/atlas_model.h"
#include "rholm/error.h"
#include "rholm/version.h"

namespace rholm {
namespace {

using hdf5::Writer;

template <class T>
void write_table(Writer& writer, Writer::Object group, const char* name,
                 const std::vector<T>& values, std::size_t columns) {
  if (columns == 1) {
    const std::array<std::uint64_t, 1> extents = {values.size()};
    writer.write_dataset(group, name, extents, values.data());
    return;
  }
  const std::array<std::uint64_t, 2> extents = {values.size() / columns, columns};
  writer.write_dataset(group, name, extents, values.data());
}

void write_group(Writer& writer, Writer::Object group, const AtlasModel& model) {
  const PackedAtlas packed = pack(model.atlas);
  const auto floats = [&](const char* name, const std::vector<float>& values, std::size_t columns) {
    if (values.empty()) return;
    write_table(writer, group, name, values, columns);
  };
  floats(layout::kCaps, packed.caps, kPackedCap);
  floats(layout::kEllipses, packed.ellipses, 5);
  floats(layout::kWeights, packed.weights, 1);
  write_table(writer, group, layout::kDegrees, packed.degrees, 1);
  write_table(writer, group, layout::kKept, packed.kept, 1);
  write_table(writer, group, layout::kValues, packed.values, 1);
  writer.write_fixed_text(group, layout::kBasis, packed.basis == CapBasis::kEven ? "even" : "full");
  if (packed.blend != CapBlend::kSmooth) {
    writer.write_fixed_text(group, layout::kBlend, to_string(packed.blend));
  }
  writer.write_attribute(group, layout::kOrigin, packed.origin);
  const std::array<double, layout::kScaleNumbers> scales = {
      packed.spacing, packed.noise, packed.band, model.step, model.tolerance};
  writer.write_attribute(group, layout::kScales, scales);
  writer.write_attribute(group, layout::kDiagonal, packed.diagonal);
  writer.write_attribute(group, layout::kWeightPower, packed.weight_power);
  if (model.errors) {
    const AtlasErrors& e = *model.errors;
    const std::array<double, layout::kErrorNumbers> errors = {e.rms_from, e.max_from, e.rms_to,
                                                              e.max_to};
    writer.write_attribute(group, layout::kAtlasErrors, errors);
  }
  writer.write_attribute(group, layout::kInputNumbers, static_cast<double>(model.input_numbers));
  if (!model.unit.empty()) writer.write_fixed_text(group, layout::kUnit, model.unit);
  if (!model.method.empty()) writer.write_fixed_text(group, layout::kMethod, model.method);
  writer.write_attribute(group, layout::kCrc32, atlas_crc32(packed));
}

void write_rules(Writer& writer, Writer::Object group, const Atlas& atlas,
                 const SurfaceRules& rules) {
  const PackedRules packed = pack_rules(atlas, rules);
  const auto doubles = [&](const char* name, const std::vector<double>& values,
                           std::size_t columns) {
    if (values.empty()) return;
    write_table(writer, group, name, values, columns);
  };
  doubles(layout::kCaps, packed.caps, kExactCap);
  doubles(layout::kCoefficients, packed.coefficients, 1);
  doubles(layout::kSpacings, packed.spacings, kSpacingNumbers);
  if (rules.seen) {
    const SeenCubes& s = *rules.seen;
    write_table(writer, group, layout::kSeen, packed.seen, 1);
    const std::array<double, layout::kSeenNumbers> frame = {s.origin.x,
                                                            s.origin.y,
                                                            s.origin.z,
                                                            s.edge,
                                                            static_cast<double>(s.size[0]),
                                                            static_cast<double>(s.size[1]),
                                                            static_cast<double>(s.size[2])};
    writer.write_attribute(group, layout::kSeenFrame, frame);
  }
  if (!rules.left_out.empty()) writer.write_texts(group, layout::kLeftOut, rules.left_out);
  writer.write_fixed_text(group, layout::kHoles, to_string(rules.holes));
  writer.write_attribute(group, layout::kMinComponent, rules.min_component);
  if (rules.simplify) {
    const SimplifyOptions& s = *rules.simplify;
    const std::array<double, layout::kSimplifyNumbers> stops = {
        static_cast<double>(s.faces), s.share, std::isinf(s.max_error) ? -1 : s.max_error};
    writer.write_attribute(group, layout::kSimplify, stops);
  }
  writer.write_attribute(group, layout::kTiles, rules.tiles ? 1 : 0);
  writer.write_attribute(group, layout::kCrc32, rules_crc32(packed, rules.left_out));
}

}  // namespace

void write_atlas(const AtlasModel& model, const std::filesystem::path& path) {
  const std::string name = path.string();
  if (model.atlas.caps.empty()) {
    throw Error(ErrorCode::kInvalidInput, name + ": an atlas without caps is not written");
  }
  AtomicFile output(path);
  if (output.temporary_path().empty()) {
    throw Error(ErrorCode::kUnsupported,
                name + ": a model file needs a file that can be rewound, not a pipe");
  }
  Writer writer(name, output.temporary_path().string());
  writer.write_fixed_text(Writer::kRoot, layout::kFormat, layout::kFormatName);
  writer.write_attribute(Writer::kRoot, layout::kVersionMajor, layout::kMajor);
  writer.write_attribute(Writer::kRoot, layout::kVersionMinor, layout::kMinor);
  writer.write_fixed_text(Writer::kRoot, layout::kProgram, std::string("rholm ") + kVersion);
  write_group(writer, writer.create_group(Writer::kRoot, layout::kAtlas), model);
  if (model.rules) {
    write_rules(writer, writer.create_group(Writer::kRoot, layout::kReconstruction), model.atlas,
                *model.rules);
  }
  writer.close();
  output.commit();
}

}  // namespace rholm
