// Writes HDF5 without the HDF5 library: the same structures as the library, in the format of
// HDF5 1.8, with less unused space. Source: HDF5 File Format Specification, version 3.0;
// comments at functions give its sections. Values are written at once. The heap of strings, the
// object headers and the superblock, which has the root's address, are written when the file is
// closed.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "io/hdf5/hdf5_bytes.h"
#include "io/hdf5/hdf5_messages.h"
#include "io/hdf5/hdf5_writer.h"
#include "rholm/error.h"

namespace rholm::hdf5 {
namespace {

void append(std::string& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

void append_checksum(std::string& bytes) { append(bytes, lookup3(bytes), 4); }

std::size_t padding(std::uint64_t size) { return (8 - size % 8) % 8; }

// IV.A.2.d: class and version, bits of the class, size, properties.
std::string datatype(const Type& type) {
  constexpr unsigned kUtf8 = 1, kZeroPadded = 1, kIsString = 1;
  std::string bytes;
  const auto head = [&](unsigned kind, std::uint32_t bits) {
    append(bytes, 0x10 | kind, 1);
    append(bytes, bits, 3);
    append(bytes, type.size, 4);
  };
  switch (type.kind) {
    case Kind::kInteger:
      head(0, type.is_signed ? 8 : 0);
      append(bytes, 0, 2);  // first bit
      append(bytes, 8 * type.size, 2);
      break;
    case Kind::kFloat: {
      const bool is_double = type.size == 8;
      // The leading bit is implied; bit 8 * size - 1 is the sign.
      head(1, 0x20U | static_cast<std::uint32_t>(8 * type.size - 1) << 8);
      append(bytes, 0, 2);
      append(bytes, 8 * type.size, 2);
      append(bytes, is_double ? 52 : 23, 1);  // exponent: position, bits
      append(bytes, is_double ? 11 : 8, 1);
      append(bytes, 0, 1);  // mantissa: position, bits
      append(bytes, is_double ? 52 : 23, 1);
      append(bytes, is_double ? 1023 : 127, 4);
      break;
    }
    case Kind::kFixedString:
      head(3, kZeroPadded | kUtf8 << 4);
      break;
    case Kind::kVariableString:
      head(9, kIsString | kUtf8 << 8);
      bytes += datatype({Kind::kInteger, 1});
      break;
  }
  return bytes;
}

// IV.A.2.b
std::string dataspace(std::span<const std::uint64_t> extents) {
  std::string bytes;
  append(bytes, 2, 1);
  append(bytes, extents.size(), 1);
  append(bytes, 0, 1);
  append(bytes, extents.empty() ? 0 : 1, 1);  // one value, or an array
  for (const std::uint64_t extent : extents) append(bytes, extent, 8);
  return bytes;
}

struct Attribute {
  std::string name;
  Type type;
  std::vector<std::uint64_t> extents;
  std::string values;         // a variable string has its length here
  std::uint32_t in_heap = 0;  // number of a variable string in the heap
};

struct Node {
  bool is_group = false;
  std::size_t members_expected = 0;
  std::vector<std::pair<std::string, Writer::Object>> members = {};
  std::vector<Attribute> attributes = {};
  // Members of a dataset.
  Type type = {};
  std::vector<std::uint64_t> extents = {};
  std::uint64_t address = kUndefined, size = 0;
};

// III.E: strings of attributes, in one collection.
class Heap {
 public:
  // Adds a string and returns its number. An empty string needs a number, too, to be a string.
  std::uint32_t add(std::string_view text) {
    append(objects_, ++count_, 2);
    append(objects_, 0, 6);
    append(objects_, text.size(), 8);
    objects_.append(text).append(padding(text.size()), '\0');
    return count_;
  }
  bool is_empty() const { return count_ == 0; }
  std::string collection() const {
    constexpr std::size_t kHead = 16, kLeast = 4096;  // the library refuses smaller ones
    const std::size_t used = kHead + objects_.size();
    const std::size_t size = std::max(kLeast, used + kHead);
    std::string bytes = "GCOL";
    append(bytes, 1, 4);
    append(bytes, size, 8);
    bytes += objects_;
    append(bytes, 0, 8);  // number 0: the remaining space is free
    append(bytes, size - used, 8);
    bytes.resize(size);
    return bytes;
  }

 private:
  std::string objects_;
  std::uint32_t count_ = 0;  // at most kMaxAttributes for each object: below 2^16
};

}  // namespace

struct Writer::Impl {
  std::string name;
  std::FILE* file = nullptr;
  std::uint64_t end = 0;
  std::vector<Node> nodes = {};
  Heap heap = {};
  std::uint64_t heap_address = 0;

  ~Impl() {
    if (file != nullptr) std::fclose(file);
  }

  [[noreturn]] void fail(const char* what) const {
    throw Error(ErrorCode::kIo,
                fmt::format("cannot write {}: cannot {}: is the disk full?", name, what));
  }

  // Writes at the end of the file; returns the address.
  std::uint64_t write(std::string_view bytes) {
    static constexpr std::string_view kZeros("\0\0\0\0\0\0\0", 7);
    const std::string_view gap = kZeros.substr(0, padding(end));
    for (const std::string_view part : {gap, bytes}) {
      if (std::fwrite(part.data(), 1, part.size(), file) != part.size()) fail("write a block");
    }
    end += gap.size() + bytes.size();
    return end - bytes.size();
  }

  Object add_member(Object group, const char* member, Node node) {
    auto& members = nodes[group].members;
    for (const auto& [other, number] : members) {
      if (other == member) fail("have two members of one name");
    }
    members.emplace_back(member, nodes.size());
    nodes.push_back(std::move(node));
    return nodes.size() - 1;
  }

  void add_attribute(Object object, Attribute attribute) {
    auto& attributes = nodes[object].attributes;
    for (const Attribute& other : attributes) {
      if (other.name == attribute.name) fail("have two attributes of one name");
    }
    if (attributes.size() == kMaxAttributes) fail("have so many attributes");
    attributes.push_back(std::move(attribute));
  }

  // --- Object headers (IV.A.1.b) -------------------------------------------------------------

  void append_message(std::string& messages, unsigned type, std::string_view data,
                      unsigned flags = 0) const {
    constexpr std::size_t kMost = 65535;
    if (data.size() > kMost) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{}: an attribute of {} bytes, more than HDF5's {}", name,
                              data.size(), kMost));
    }
    append(messages, type, 1);
    append(messages, data.size(), 2);
    append(messages, flags, 1);
    messages += data;
  }

  // IV.A.2.m, version 3: ASCII names with their closing zero.
  std::string attribute_message(const Attribute& attribute) const {
    const std::string type = datatype(attribute.type), space = dataspace(attribute.extents);
    std::string bytes;
    append(bytes, 3, 2);
    append(bytes, attribute.name.size() + 1, 2);
    append(bytes, type.size(), 2);
    append(bytes, space.size(), 2);
    append(bytes, 0, 1);
    bytes.append(attribute.name).append(1, '\0').append(type).append(space);
    bytes += attribute.values;
    if (attribute.type.kind == Kind::kVariableString) {
      append(bytes, heap_address, 8);
      append(bytes, attribute.in_heap, 4);
    }
    return bytes;
  }

  void append_attributes(std::string& messages, const Node& node) const {
    if (node.attributes.empty()) return;
    std::string info;  // IV.A.2.v: no attributes in dense storage
    append(info, 0, 2);
    append(info, kUndefined, 8);
    append(info, kUndefined, 8);
    append_message(messages, kAttributeInfoMessage, info);
    for (const Attribute& attribute : node.attributes) {
      append_message(messages, kAttributeMessage, attribute_message(attribute));
    }
  }

  // IV.A.2.c, IV.A.2.k, IV.A.2.g: no links in dense storage, limit of links in the header,
  // links.
  void append_links(std::string& messages, const Node& node,
                    const std::vector<std::uint64_t>& addresses) const {
    std::string info;
    append(info, 0, 2);
    append(info, kUndefined, 8);
    append(info, kUndefined, 8);
    append_message(messages, kLinkInfoMessage, info);
    std::string group;
    append(group, 0, 1);
    append(group, node.members_expected > 0 ? 1 : 0, 1);
    if (node.members_expected > 0) append(group, node.members_expected, 4);  // dense limit is 0
    append_message(messages, kGroupInfoMessage, group, kConstant);
    for (const auto& [member, number] : node.members) {
      std::string link;
      append(link, 1, 1);
      append(link, 1, 1);  // the length of names has two bytes
      append(link, member.size(), 2);
      link += member;
      append(link, addresses[number], 8);
      append_message(messages, kLinkMessage, link);
    }
  }

  // IV.A.2.b, IV.A.2.d, IV.A.2.f, IV.A.2.i: contiguous, late allocation, default fill value.
  void append_array(std::string& messages, const Node& node) const {
    append_message(messages, kDataspaceMessage, dataspace(node.extents));
    append_message(messages, kDatatypeMessage, datatype(node.type), kConstant);
    append_message(messages, kFillValueMessage, "\x03\x0a", kConstant);
    std::string layout = "\x03\x01";
    append(layout, node.address, 8);
    append(layout, node.size, 8);
    append_message(messages, kLayoutMessage, layout);
  }

  std::string header(const std::string& messages) const {
    constexpr unsigned kSizeOf4Bytes = 2, kAttributeLimits = 0x10;
    std::string bytes = "OHDR";
    append(bytes, 2, 1);
    append(bytes, kSizeOf4Bytes | kAttributeLimits, 1);
    append(bytes, kMaxAttributes, 4);  // limit of compact storage, then 0 for dense storage
    append(bytes, messages.size(), 4);
    bytes += messages;
    append_checksum(bytes);
    return bytes;
  }

  // Writes members before their groups; returns the address of the root, which is nodes[0].
  std::uint64_t write_headers() {
    std::vector<std::uint64_t> addresses(nodes.size());
    for (Object object = nodes.size(); object-- > 0;) {
      const Node& node = nodes[object];
      std::string messages;
      if (node.is_group) {
        append_links(messages, node, addresses);
      } else {
        append_array(messages, node);
      }
      append_attributes(messages, node);
      addresses[object] = write(header(messages));
    }
    return addresses[kRoot];
  }

  // II.C, version 2.
  std::string superblock(std::uint64_t root) const {
    std::string bytes = "\x89HDF\r\n\x1a\n";
    append(bytes, 2, 1);
    append(bytes, 8, 1);  // bytes of an address, then of a length
    append(bytes, 8, 1);
    append(bytes, 0, 1);
    append(bytes, 0, 8);  // base
    append(bytes, kUndefined, 8);
    append(bytes, end, 8);
    append(bytes, root, 8);
    append_checksum(bytes);
    return bytes;
  }

  static constexpr unsigned kGroupInfoMessage = 0x0a, kFillValueMessage = 0x05;
  static constexpr unsigned kConstant = 1;  // a flag of messages
  static constexpr std::size_t kSuperblock = 48;
};

Writer::Writer(std::string name, const std::string& path, std::size_t members)
    : impl_(std::make_unique<Impl>()) {
  impl_->name = std::move(name);
  check_members(impl_->name, members);
  impl_->nodes.push_back({.is_group = true, .members_expected = members});
  impl_->file = std::fopen(path.c_str(), "wb");
  if (impl_->file == nullptr) impl_->fail("create the file");
  impl_->write(std::string(Impl::kSuperblock, '\0'));
}
Writer::~Writer() = default;

Writer::Object Writer::create_group(Object parent, const char* name) {
  return impl_->add_member(parent, name, {.is_group = true});
}

void Writer::put_text(Object object, const char* name, const std::string& value) {
  const std::string text = value.substr(0, value.find('\0'));  // the library takes C strings
  std::string length;
  append(length, text.size(), 4);
  impl_->add_attribute(object,
                       {name, {Kind::kVariableString, 16}, {}, length, impl_->heap.add(text)});
}

void Writer::put_attribute(Object object, const char* name, const Type& type,
                           std::span<const std::uint64_t> extents, const void* values) {
  std::size_t size = type.size;
  for (const std::uint64_t extent : extents) size *= extent;
  impl_->add_attribute(object, {name, type, std::vector(extents.begin(), extents.end()),
                                std::string(static_cast<const char*>(values), size)});
}

Writer::Object Writer::put_dataset(Object group, const char* name, const Type& type,
                                   std::span<const std::uint64_t> extents, const void* values) {
  Node node = {.type = type, .extents = std::vector(extents.begin(), extents.end())};
  node.size = type.size;
  for (const std::uint64_t extent : extents) node.size *= extent;
  if (node.size > 0) node.address = impl_->write({static_cast<const char*>(values), node.size});
  return impl_->add_member(group, name, std::move(node));
}

void Writer::close() {
  if (!impl_->heap.is_empty()) impl_->heap_address = impl_->write(impl_->heap.collection());
  const std::string superblock = impl_->superblock(impl_->write_headers());
  std::FILE* const file = std::exchange(impl_->file, nullptr);
  const bool written =
      std::fseek(file, 0, SEEK_SET) == 0 &&
      std::fwrite(superblock.data(), 1, superblock.size(), file) == superblock.size();
  if (std::fclose(file) != 0 || !written) impl_->fail("close the file");
}

}  // namespace rholm::hdf5
