// Writing by the HDF5 library, with handles that close themselves.
#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <mutex>
#include <utility>
#include <vector>

#include "io/hdf5/hdf5_writer.h"
#include "rholm/error.h"

namespace rholm::hdf5 {
namespace {

// An identifier of the library with the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept { swap(other); }
  Handle& operator=(Handle&& other) noexcept {
    Handle(std::move(other)).swap(*this);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  // Closes now and returns true on success (writing buffered data may fail).
  bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }
  // NOLINTNEXTLINE(misc-explicit-constructor): it stands wherever the library takes an identifier
  operator hid_t() const { return id_; }

 private:
  void swap(Handle& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
  }
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

// While an object of this class exists, this thread alone uses HDF5, which prints no errors. Some
// builds of the library are not thread-safe and keep state between calls.
class QuietErrors {
 public:
  QuietErrors() : alone_(mutex) {
    // At the end of the process HDF5 would close again a file that it could not close (a full
    // disk), and crash. It has nothing to close, because handles close themselves.
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() {
    H5Eclear2(H5E_DEFAULT);
    H5Eset_auto2(H5E_DEFAULT, print_, data_);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  static inline std::mutex mutex;
  std::lock_guard<std::mutex> alone_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

// Returns the type of numbers as they are in memory, which is little endian.
hid_t number_type(const Type& type) {
  if (type.kind == Kind::kFloat) return type.size == 4 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  switch (type.size) {
    case 1:
      return type.is_signed ? H5T_STD_I8LE : H5T_STD_U8LE;
    case 2:
      return type.is_signed ? H5T_STD_I16LE : H5T_STD_U16LE;
    case 4:
      return type.is_signed ? H5T_STD_I32LE : H5T_STD_U32LE;
    default:
      return type.is_signed ? H5T_STD_I64LE : H5T_STD_U64LE;
  }
}

herr_t leave_open(hid_t) { return 0; }

}  // namespace

struct Writer::Impl {
  // A group is open; a dataset has its group and its name, to be opened again.
  struct Node {
    Handle group;
    Object parent = 0;
    std::string name = {};
  };

  QuietErrors quiet;  // first, so that it is destroyed last
  std::string name;
  Handle file = {-1, nullptr};
  std::vector<Node> nodes = {};

  template <typename Result>
  Result checked(Result result, const char* what) const {
    if (result < 0) {
      throw Error(ErrorCode::kIo,
                  fmt::format("cannot write {}: HDF5 cannot {}: is the disk full?", name, what));
    }
    return result;
  }

  void create_file(const std::string& path, std::size_t members) {
    // In the format of HDF5 1.8, every block of metadata has a checksum.
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    checked(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "choose its version");
    // No other process uses this temporary file; some network file systems have no locks.
    checked(H5Pset_file_locking(access, false, true), "switch off locks");
    // The file may have no name: the other drivers need the target path of "/proc/self/fd/3".
    checked(H5Pset_fapl_stdio(access), "choose how to write");
    const Handle creation = quiet_creation(H5P_FILE_CREATE);  // for the root group, too
    if (members > 0) keep_members(creation, members);
    file =
        Handle(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), "create the file"),
               H5Fclose);
    nodes.push_back({Handle(checked(H5Gopen2(file, "/", H5P_DEFAULT), "open the root"), H5Gclose)});
  }

  // Keeps all links in the header of their group, as attributes are in the header of their object.
  void keep_members(hid_t creation, std::size_t members) const {
    check_members(name, members);
    checked(H5Pset_link_phase_change(creation, static_cast<unsigned>(members), 0),
            "keep the members of a group");
    // Reserves room for all links: three thousand take 0.3 s, but 20 s if the header has to grow.
    constexpr unsigned kNameLength = 32;  // a guess; a wrong one costs nothing
    checked(H5Pset_est_link_info(creation, static_cast<unsigned>(members), kNameLength),
            "make room for the members of a group");
  }

  // Same coefficients, same bytes: objects have no times of creation. Attributes always stay in the
  // header of their object: HDF5's other storage for attributes is far less simple.
  Handle quiet_creation(hid_t kind) const {
    Handle creation(checked(H5Pcreate(kind), "create properties"), H5Pclose);
    checked(H5Pset_obj_track_times(creation, false), "leave out times");
    checked(H5Pset_attr_phase_change(creation, kMaxAttributes, 0), "keep attributes");
    return creation;
  }

  Handle type_of(const Type& type) const {
    if (type.kind != Kind::kFixedString) return {number_type(type), leave_open};
    Handle text(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
    checked(H5Tset_size(text, type.size), "set the size of a string");
    checked(H5Tset_strpad(text, H5T_STR_NULLPAD), "set the padding of a string");
    checked(H5Tset_cset(text, H5T_CSET_UTF8), "set the characters of a string");
    return text;
  }

  Handle space_of(std::span<const std::uint64_t> extents) const {
    std::vector<hsize_t> sizes(extents.begin(), extents.end());
    return {checked(sizes.empty()
                        ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
                    "create a space"),
            H5Sclose};
  }

  void write_attribute(Object object, const char* attribute, hid_t type, hid_t space,
                       const void* value) const {
    const Node& node = nodes[object];
    const bool is_dataset = node.group < 0;
    const Handle dataset(
        is_dataset ? checked(H5Dopen2(nodes[node.parent].group, node.name.c_str(), H5P_DEFAULT),
                             "open a dataset")
                   : -1,
        H5Dclose);
    const hid_t owner = is_dataset ? static_cast<hid_t>(dataset) : static_cast<hid_t>(node.group);
    const Handle made(checked(H5Acreate2(owner, attribute, type, space, H5P_DEFAULT, H5P_DEFAULT),
                              "create an attribute"),
                      H5Aclose);
    checked(H5Awrite(made, type, value), "write an attribute");
  }
};

Writer::Writer(std::string name, const std::string& path, std::size_t members)
    : impl_(std::make_unique<Impl>()) {
  impl_->name = std::move(name);
  impl_->create_file(path, members);
}
Writer::~Writer() = default;

Writer::Object Writer::create_group(Object parent, const char* name) {
  const Handle creation = impl_->quiet_creation(H5P_GROUP_CREATE);
  const hid_t made = impl_->checked(
      H5Gcreate2(impl_->nodes[parent].group, name, H5P_DEFAULT, creation, H5P_DEFAULT),
      "create a group");
  impl_->nodes.push_back({Handle(made, H5Gclose)});
  return impl_->nodes.size() - 1;
}

void Writer::put_text(Object object, const char* name, const std::string& value) {
  const Handle type(impl_->checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
  impl_->checked(H5Tset_size(type, H5T_VARIABLE), "set the size of a string");
  impl_->checked(H5Tset_cset(type, H5T_CSET_UTF8), "set the characters of a string");
  const char* text = value.c_str();
  impl_->write_attribute(object, name, type, impl_->space_of({}), static_cast<const void*>(&text));
}

void Writer::put_attribute(Object object, const char* name, const Type& type,
                           std::span<const std::uint64_t> extents, const void* values) {
  impl_->write_attribute(object, name, impl_->type_of(type), impl_->space_of(extents), values);
}

Writer::Object Writer::put_dataset(Object group, const char* name, const Type& type,
                                   std::span<const std::uint64_t> extents, const void* values) {
  const Handle held = impl_->type_of(type), space = impl_->space_of(extents);
  const Handle creation = impl_->quiet_creation(H5P_DATASET_CREATE);
  impl_->checked(H5Pset_layout(creation, H5D_CONTIGUOUS), "choose a layout");
  Handle dataset(impl_->checked(H5Dcreate2(impl_->nodes[group].group, name, held, space,
                                           H5P_DEFAULT, creation, H5P_DEFAULT),
                                "create a dataset"),
                 H5Dclose);
  impl_->checked(H5Dwrite(dataset, held, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write a dataset");
  if (!dataset.close()) impl_->checked(-1, "write a dataset");
  impl_->nodes.push_back({Handle(-1, nullptr), group, name});
  return impl_->nodes.size() - 1;
}

void Writer::close() {
  while (!impl_->nodes.empty()) impl_->nodes.pop_back();
  if (!impl_->file.close()) impl_->checked(-1, "close the file");
}

}  // namespace rholm::hdf5
