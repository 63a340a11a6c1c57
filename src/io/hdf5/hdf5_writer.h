// Groups, attributes and datasets of a model file, written. Layer: io, private.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "io/hdf5/hdf5_handle.h"
#include "rholm/error.h"
#include "rholm/vec3.h"

namespace rholm::hdf5 {

// Of one object, all in its header (chosen: ample).
inline constexpr unsigned kMaxAttributes = 64;

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

  // `members` is how many the root will have, if that is more than a handful.
  Handle create_file(const std::string& path, std::size_t members = 0) const {
    // The format of HDF5 1.8: every block of metadata has a checksum.
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    checked(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "choose its version");
    // The file is temporary and ours alone; some network file systems have no locks.
    checked(H5Pset_file_locking(access, false, true), "switch off locks");
    // It may have no name: the driver of all other files wants the path of "/proc/self/fd/3".
    checked(H5Pset_fapl_stdio(access), "choose how to write");
    const Handle creation = quiet_creation(H5P_FILE_CREATE);  // of the root group, too
    if (members > 0) keep_members(creation, members);
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
    write_attribute(object, name, type, type, space, static_cast<const void*>(&text));
  }
  // A string of its own length: it needs no heap, which takes 4 KiB of the file.
  void write_fixed_text(hid_t object, const char* name, const std::string& value) const {
    const Handle type(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
    checked(H5Tset_size(type, std::max<std::size_t>(1, value.size())), "set the size of a string");
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "set the padding of a string");
    checked(H5Tset_cset(type, H5T_CSET_UTF8), "set the characters of a string");
    const Handle space(checked(H5Screate(H5S_SCALAR), "create a space"), H5Sclose);
    write_attribute(object, name, type, type, space, value.c_str());
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
    write_attribute(object, name, std::span<const double>(numbers));
  }
  void write_attribute(hid_t object, const char* name, std::span<const double> numbers) const {
    const hsize_t size = numbers.size();
    const Handle space(checked(H5Screate_simple(1, &size, nullptr), "create a space"), H5Sclose);
    write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, numbers.data());
  }

  // A dataset of its own, contiguous.
  void write_dataset(hid_t group, const char* name, std::span<const hsize_t> extents,
                     hid_t file_type, hid_t memory_type, const void* values) const {
    const Handle space(
        checked(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                "create a space"),
        H5Sclose);
    const Handle creation = quiet_creation(H5P_DATASET_CREATE);
    checked(H5Pset_layout(creation, H5D_CONTIGUOUS), "choose a layout");
    Handle dataset(
        checked(H5Dcreate2(group, name, file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                "create a dataset"),
        H5Dclose);
    checked(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
            "write a dataset");
    if (!dataset.close()) checked(-1, "write a dataset");
  }

  // Texts of one length, the longest one's, the others filled with zeros.
  void write_texts(hid_t group, const char* name, std::span<const std::string> texts) const {
    std::size_t length = 1;
    for (const std::string& text : texts) length = std::max(length, text.size());
    std::string bytes(length * texts.size(), '\0');
    for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&bytes[i * length], length);
    const Handle type(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
    checked(H5Tset_size(type, length), "set the size of a string");
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "set the padding of a string");
    checked(H5Tset_cset(type, H5T_CSET_UTF8), "set the characters of a string");
    const hsize_t extent = texts.size();
    write_dataset(group, name, {&extent, 1}, type, type, bytes.data());
  }

 private:
  // Links stay in the header of their group, however many, as attributes do.
  void keep_members(hid_t creation, std::size_t members) const {
    constexpr std::size_t kMostMembers = 65535;  // HDF5 counts them in 16 bits
    if (members > kMostMembers) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{} would have {} datasets, more than {}: write .csv", name_, members,
                              kMostMembers));
    }
    checked(H5Pset_link_phase_change(creation, static_cast<unsigned>(members), 0),
            "keep the members of a group");
    // Room for all at once: three thousand links take 0.3 s, and 20 s where the header has to grow.
    constexpr unsigned kNameLength = 32;  // a guess that costs nothing if it is wrong
    checked(H5Pset_est_link_info(creation, static_cast<unsigned>(members), kNameLength),
            "make room for the members of a group");
  }

  // Same coefficients, same bytes: objects without times of creation. Attributes stay in the
  // header of their object, however many: HDF5's other storage for them is far less simple.
  Handle quiet_creation(hid_t kind) const {
    Handle creation(checked(H5Pcreate(kind), "create properties"), H5Pclose);
    checked(H5Pset_obj_track_times(creation, false), "leave out times");
    checked(H5Pset_attr_phase_change(creation, kMaxAttributes, 0), "keep attributes");
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

}  // namespace rholm::hdf5
