// The model file, written. Layout: docs/model-file.md.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/atomic_file.h"
#include "io/expansion_check.h"
#include "model/crc32.h"
#include "model/hdf5_handle.h"
#include "model/model_layout.h"
#include "rholm/model.h"
#include "rholm/rholm.h"

namespace rholm {
namespace {

using hdf5::Handle;

class Writer {
 public:
  explicit Writer(std::string name) : name_(std::move(name)) {}

  template <typename Result>
  Result checked(Result result, const char* what) const {
    if (result < 0) {
      throw Error(ErrorCode::kIo,
                  fmt::format("cannot write {}: HDF5 cannot {}: is the disk full?", name_, what));
    }
    return result;
  }

  Handle create_file(const std::string& path) const {
    // The format of HDF5 1.8: every block of metadata has a checksum.
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    checked(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "choose its version");
    // The file is temporary and ours alone; some network file systems have no locks.
    checked(H5Pset_file_locking(access, false, true), "switch off locks");
    const Handle creation = quiet_creation(H5P_FILE_CREATE);  // of the root group, too
    return Handle(
        checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), "create the file"),
        H5Fclose);
  }

  Handle create_group(hid_t parent, const char* name) const {
    const Handle creation = quiet_creation(H5P_GROUP_CREATE);
    return Handle(
        checked(H5Gcreate2(parent, name, H5P_DEFAULT, creation, H5P_DEFAULT), "create a group"),
        H5Gclose);
  }

  void write_attribute(hid_t object, const char* name, const std::string& value) const {
    const Handle type(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
    checked(H5Tset_size(type, H5T_VARIABLE), "set the size of a string");
    checked(H5Tset_cset(type, H5T_CSET_UTF8), "set the characters of a string");
    const char* text = value.c_str();
    const Handle space(checked(H5Screate(H5S_SCALAR), "create a space"), H5Sclose);
    write_attribute(object, name, type, type, space, &text);
  }
  void write_attribute(hid_t object, const char* name, int value) const {
    const Handle space(checked(H5Screate(H5S_SCALAR), "create a space"), H5Sclose);
    write_attribute(object, name, H5T_STD_I32LE, H5T_NATIVE_INT, space, &value);
  }
  void write_attribute(hid_t object, const char* name, std::uint32_t value) const {
    const Handle space(checked(H5Screate(H5S_SCALAR), "create a space"), H5Sclose);
    write_attribute(object, name, H5T_STD_U32LE, H5T_NATIVE_UINT32, space, &value);
  }
  void write_attribute(hid_t object, const char* name, double value) const {
    const Handle space(checked(H5Screate(H5S_SCALAR), "create a space"), H5Sclose);
    write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, &value);
  }
  void write_attribute(hid_t object, const char* name, const Vec3& value) const {
    const std::array<double, 3> numbers = {value.x, value.y, value.z};
    const hsize_t size = numbers.size();
    const Handle space(checked(H5Screate_simple(1, &size, nullptr), "create a space"), H5Sclose);
    write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, numbers.data());
  }

  void write_coefficients(hid_t group, const Coefficients& coefficients) const {
    const hsize_t side = static_cast<hsize_t>(coefficients.degree()) + 1;
    const std::array<hsize_t, 3> extents = {2, side, side};
    const Handle space(checked(H5Screate_simple(3, extents.data(), nullptr), "create a space"),
                       H5Sclose);
    const Handle creation = quiet_creation(H5P_DATASET_CREATE);
    checked(H5Pset_layout(creation, H5D_CONTIGUOUS), "choose a layout");
    Handle dataset(checked(H5Dcreate2(group, layout::kCoefficients, H5T_IEEE_F64LE, space,
                                      H5P_DEFAULT, creation, H5P_DEFAULT),
                           "create the dataset"),
                   H5Dclose);
    checked(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                     coefficients.values().data()),
            "write the coefficients");
    if (!dataset.close()) checked(-1, "write the coefficients");
  }

 private:
  // Same coefficients, same bytes: objects without times of creation. Attributes stay in the
  // header of their object, however many: HDF5's other storage for them is far less simple.
  Handle quiet_creation(hid_t kind) const {
    Handle creation(checked(H5Pcreate(kind), "create properties"), H5Pclose);
    checked(H5Pset_obj_track_times(creation, false), "leave out times");
    checked(H5Pset_attr_phase_change(creation, layout::kMaxAttributes, 0), "keep attributes");
    return creation;
  }

  void write_attribute(hid_t object, const char* name, hid_t file_type, hid_t memory_type,
                       hid_t space, const void* value) const {
    Handle attribute(checked(H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT),
                             "create an attribute"),
                     H5Aclose);
    checked(H5Awrite(attribute, memory_type, value), "write an attribute");
  }

  std::string name_;
};

// Over the coefficients as they stand in the file, unit and method: what HDF5 itself leaves
// without a checksum.
std::uint32_t model_crc32(const Expansion& expansion) {
  static_assert(std::endian::native == std::endian::little, "the file is little endian");
  const std::span<const double> values = expansion.coefficients.values();
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return crc32(expansion.method, crc32(expansion.unit, crc32(bytes)));
}

void write_errors(const Writer& writer, hid_t group, const TruncationErrors& errors) {
  const auto write = [&](const char* name, const std::optional<double>& value) {
    if (value) writer.write_attribute(group, name, *value);
  };
  write(layout::kErrorRms, errors.rms);
  writer.write_attribute(group, layout::kErrorRmsIsExact, errors.rms_is_exact ? 1 : 0);
  write(layout::kPredictedMax, errors.predicted_max);
  write(layout::kPredictedMaxDistance, errors.predicted_max_distance);
  write(layout::kMeasuredMax, errors.measured_max);
  write(layout::kMeasuredMaxDistance, errors.measured_max_distance);
  write(layout::kDistanceRms, errors.distance_rms);
  writer.write_attribute(group, layout::kErrorPoints, static_cast<double>(errors.points));
  writer.write_attribute(group, layout::kDiagonal, errors.diagonal);
}

void write_expansion(const Writer& writer, hid_t group, const Expansion& expansion) {
  writer.write_coefficients(group, expansion.coefficients);
  writer.write_attribute(group, layout::kDegree, expansion.coefficients.degree());
  writer.write_attribute(group, layout::kNormalization, to_string(Normalization::kOrthonormal));
  writer.write_attribute(group, layout::kCsphase, 1);
  writer.write_attribute(group, layout::kFunction, to_string(expansion.function));
  writer.write_attribute(group, layout::kCenter, expansion.center);
  writer.write_attribute(group, layout::kUnit, expansion.unit);
  writer.write_attribute(group, layout::kMethod, expansion.method);
  writer.write_attribute(group, layout::kCrc32, model_crc32(expansion));
  if (expansion.norm_squared) {
    writer.write_attribute(group, layout::kNormSquared, *expansion.norm_squared);
  }
  if (expansion.tail_strength) {
    writer.write_attribute(group, layout::kTailStrength, *expansion.tail_strength);
  }
  if (expansion.errors) write_errors(writer, group, *expansion.errors);
}

}  // namespace

void write_model(const Expansion& expansion, const std::filesystem::path& path) {
  const std::string name = path.string();
  check_expansion(expansion, name);
  AtomicFile output(path);
  if (output.temporary_path().empty()) {
    throw Error(ErrorCode::kUnsupported, name +
                                             ": a model file needs a file that can be "
                                             "rewound, not a pipe: write .json instead");
  }
  const hdf5::QuietErrors quiet;
  const Writer writer(name);
  Handle file = writer.create_file(output.temporary_path().string());
  {
    const Handle root(writer.checked(H5Gopen2(file, "/", H5P_DEFAULT), "open the root"), H5Gclose);
    writer.write_attribute(root, layout::kFormat, layout::kFormatName);
    writer.write_attribute(root, layout::kVersionMajor, layout::kMajor);
    writer.write_attribute(root, layout::kVersionMinor, layout::kMinor);
    writer.write_attribute(root, layout::kProgram, std::string("rholm ") + kVersion);
    write_expansion(writer, writer.create_group(file, layout::kExpansion), expansion);
  }
  if (!file.close()) writer.checked(-1, "close the file");
  output.commit();
}

}  // namespace rholm
