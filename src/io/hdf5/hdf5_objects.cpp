#include "io/hdf5/hdf5_objects.h"

#include <algorithm>
#include <deque>
#include <optional>

#include "base/crc32.h"
#include "io/hdf5/hdf5_bytes.h"
#include "io/hdf5/hdf5_messages.h"

namespace rholm::hdf5 {
namespace {

constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";

void check_checksum(const File& file, std::string_view covered, std::uint32_t stored) {
  if (lookup3(covered) != stored && !kAnyChecksum) damaged(file, "a checksum is wrong");
}

void check_sizes(const File& file, unsigned offsets, unsigned lengths) {
  if (offsets != 8 || lengths != 8) unsupported(file, "HDF5 addresses of other than 8 bytes");
}

void check_extent(const File& file, std::uint64_t base, std::uint64_t end) {
  if (base != 0) unsupported(file, "an HDF5 file with a base address");
  if (end > file.bytes.size()) {
    damaged(file, "it has " + std::to_string(file.bytes.size()) + " bytes and says " +
                      std::to_string(end) + ": it is cut off");
  }
}

// Reads superblock version 0 or 1, after signature and version; returns the root's address.
std::uint64_t read_old_superblock(const File& file, ByteReader& block, unsigned version) {
  block.skip(4);
  const unsigned offsets = block.u8();
  check_sizes(file, offsets, block.u8());
  block.skip(version == 1 ? 13 : 9);
  const std::uint64_t base = block.u64();
  block.skip(8);
  check_extent(file, base, block.u64());
  block.skip(16);
  return block.u64();
}

// Reads superblock version 2 or 3.
std::uint64_t read_superblock(const File& file, ByteReader& block) {
  const unsigned offsets = block.u8();
  check_sizes(file, offsets, block.u8());
  block.skip(1);
  const std::uint64_t base = block.u64();
  block.skip(8);
  const std::uint64_t end = block.u64();
  const std::uint64_t root = block.u64();
  const std::string_view covered = block.passed();
  check_checksum(file, covered, block.u32());
  check_extent(file, base, end);
  return root;
}

// Reads the messages of an object header, block by block.
class HeaderReader {
 public:
  HeaderReader(const File& file, std::string path) : file_(file) { object_.path = std::move(path); }

  Object read(std::uint64_t address) {
    const std::string_view bytes = bytes_from(file_, address);
    if (bytes.starts_with("OHDR")) {
      read_first_block(bytes);
    } else {
      read_first_old_block(bytes);
    }
    while (!continuations_.empty()) {
      const std::string_view block = continuations_.front();
      continuations_.pop_front();
      read_continuation(block);
    }
    return std::move(object_);
  }

 private:
  void read_first_old_block(std::string_view bytes) {
    ByteReader header(file_, bytes);
    if (header.u8() != 1) damaged(file_, "no object header where one must be");
    header.skip(1);
    messages_left_ = header.u16();
    header.skip(4);
    const std::uint32_t size = header.u32();
    header.skip(4);
    old_ = true;
    read_old_messages(header.take(size));
  }

  void read_first_block(std::string_view bytes) {
    ByteReader header(file_, bytes);
    header.expect("OHDR");
    if (header.u8() != 2) unsupported(file_, "an HDF5 object header of an unknown version");
    const unsigned flags = header.u8();
    has_creation_order_ = (flags & 4) != 0;
    if ((flags & 0x20) != 0) header.skip(16);  // times
    if ((flags & 0x10) != 0) header.skip(4);   // limits of dense storage
    const std::uint64_t size = header.number(std::size_t{1} << (flags & 3));
    const std::string_view messages = header.take(size);
    const std::string_view covered = header.passed();
    check_checksum(file_, covered, header.u32());
    read_messages(messages);
  }

  void read_continuation(std::string_view block) {
    if (old_) return read_old_messages(block);
    if (block.size() < 8) damaged(file_, "an object header continues in too short a block");
    const std::string_view covered = block.substr(0, block.size() - 4);
    check_checksum(file_, covered, ByteReader(file_, block.substr(covered.size())).u32());
    ByteReader messages(file_, covered);
    messages.expect("OCHK");
    read_messages(messages.take(messages.left()));
  }

  void read_old_messages(std::string_view block) {
    ByteReader reader(file_, block);
    while (reader.left() >= 8 && messages_left_ > 0) {
      const unsigned type = reader.u16();
      const unsigned size = reader.u16();
      const unsigned flags = reader.u8();
      reader.skip(3);
      --messages_left_;
      add(type, flags, reader.take(size));
    }
  }

  void read_messages(std::string_view block) {
    ByteReader reader(file_, block);
    const std::size_t prefix = has_creation_order_ ? 6 : 4;
    while (reader.left() >= prefix) {  // a shorter remainder is a gap
      const unsigned type = reader.u8();
      const unsigned size = reader.u16();
      const unsigned flags = reader.u8();
      if (has_creation_order_) reader.skip(2);
      add(type, flags, reader.take(size));
    }
  }

  void add(unsigned type, unsigned flags, std::string_view data) {
    if (type == kContinuationMessage) {
      ByteReader message(file_, data);
      const std::uint64_t address = message.u64();
      const std::string_view block = bytes_at(file_, address, message.u64());
      // Blocks do not overlap in an undamaged file: the limit ends every loop of continuations.
      continued_bytes_ += block.size() + 1;
      if (continued_bytes_ > file_.bytes.size()) damaged(file_, "an object header has no end");
      continuations_.push_back(block);
    } else {
      // Bit 1 means that the message is stored elsewhere, for several objects.
      if ((flags & 2) != 0 && is_used(type)) unsupported(file_, "an HDF5 file with shared types");
      object_.messages.push_back({type, data});
    }
  }

  const File& file_;
  Object object_;
  bool old_ = false;
  bool has_creation_order_ = false;
  unsigned messages_left_ = 0;
  std::deque<std::string_view> continuations_;
  std::uint64_t continued_bytes_ = 0;
};

struct Link {
  bool hard = false;
  std::uint64_t address = 0;
};

// A group of the old format: a B-tree over names, which are in a heap.
class SymbolTable {
 public:
  SymbolTable(const File& file, std::string_view message) : file_(file) {
    ByteReader reader(file, message);
    tree_ = reader.u64();
    ByteReader heap(file, bytes_from(file, reader.u64()));
    heap.expect("HEAP");
    heap.skip(4);
    const std::uint64_t size = heap.u64();
    heap.skip(8);
    names_ = bytes_at(file, heap.u64(), size);
  }

  std::optional<Link> find(std::string_view name) { return find_in_node(tree_, name, kMaxLevel); }

 private:
  // Levels decrease towards the leaves. A group with more entries than a tree of 8 levels holds
  // would not fit into any file. The search reads all names: models have few.
  static constexpr unsigned kMaxLevel = 8;

  // In an undamaged file, each node occurs once and an entry takes at least 8 bytes. The limit ends
  // every search that repeats nodes.
  void count_visit(unsigned entries) {
    visited_ += 1 + entries;
    if (visited_ > file_.bytes.size() / 8) damaged(file_, "a group has no end");
  }

  std::optional<Link> find_in_node(std::uint64_t address, std::string_view name, unsigned below) {
    ByteReader node(file_, bytes_from(file_, address));
    node.expect("TREE");
    if (node.u8() != 0) damaged(file_, "a group is not a group");
    const unsigned level = node.u8();
    if (level >= below) damaged(file_, "the levels of a group are out of order");
    const unsigned entries = node.u16();
    count_visit(entries);
    node.skip(16);
    for (unsigned i = 0; i < entries; ++i) {
      node.skip(8);
      const std::uint64_t child = node.u64();
      const auto link = level > 0 ? find_in_node(child, name, level) : find_in_leaf(child, name);
      if (link) return link;
    }
    return std::nullopt;
  }

  std::optional<Link> find_in_leaf(std::uint64_t address, std::string_view name) {
    ByteReader leaf(file_, bytes_from(file_, address));
    leaf.expect("SNOD");
    leaf.skip(2);
    const unsigned entries = leaf.u16();
    count_visit(entries);
    for (unsigned i = 0; i < entries; ++i) {
      const std::uint64_t name_at = leaf.u64();
      const std::uint64_t object = leaf.u64();
      const std::uint32_t cache = leaf.u32();
      leaf.skip(20);
      if (name_at > names_.size()) damaged(file_, "a name lies outside its heap");
      // Compares the closing zero, too, without searching: a heap without zeros costs nothing.
      const std::string_view stored = names_.substr(name_at, name.size() + 1);
      if (stored.size() == name.size() + 1 && stored.starts_with(name) && stored.back() == '\0') {
        constexpr std::uint32_t kSoftLink = 2;
        return Link{cache != kSoftLink, object};
      }
    }
    return std::nullopt;
  }

  const File& file_;
  std::uint64_t tree_ = 0;
  std::string_view names_;
  std::size_t visited_ = 0;
};

std::optional<Link> match_link_message(const File& file, std::string_view data,
                                       std::string_view name) {
  ByteReader message(file, data);
  if (message.u8() != 1) unsupported(file, "an HDF5 link of an unknown version");
  const unsigned flags = message.u8();
  const unsigned type = (flags & 8) != 0 ? message.u8() : 0;
  if ((flags & 4) != 0) message.skip(8);     // creation order
  if ((flags & 0x10) != 0) message.skip(1);  // character set
  const std::uint64_t length = message.number(std::size_t{1} << (flags & 3));
  if (message.take(length) != name) return std::nullopt;
  return Link{type == 0, type == 0 ? message.u64() : 0};
}

std::optional<Link> find_link(const File& file, const Object& group, std::string_view name) {
  bool is_group = false;
  for (const Message& message : group.messages) {
    std::optional<Link> link;
    if (message.type == kSymbolTableMessage) {
      link = SymbolTable(file, message.data).find(name);
    } else if (message.type == kLinkMessage) {
      link = match_link_message(file, message.data, name);
    } else if (message.type == kLinkInfoMessage) {
      ByteReader info(file, message.data);
      info.skip(1);
      if ((info.u8() & 1) != 0) info.skip(8);
      if (info.u64() != kUndefined) {
        unsupported(file, "the group '" + group.path +
                              "' has many members, in HDF5's dense storage: keep it to 8");
      }
    } else {
      continue;
    }
    is_group = true;
    if (link) return link;
  }
  if (!is_group) damaged(file, "'" + group.path + "' is not a group");
  return std::nullopt;
}

}  // namespace

bool has_signature(std::string_view bytes) { return bytes.starts_with(kSignature); }

File open(std::string_view bytes, const std::string& name) {
  File file{bytes, name};
  ByteReader block(file, bytes);
  block.expect(kSignature);
  const unsigned version = block.u8();
  if (version > 3) unsupported(file, "HDF5 superblock version " + std::to_string(version));
  file.root =
      version < 2 ? read_old_superblock(file, block, version) : read_superblock(file, block);
  return file;
}

Object root_group(const File& file) { return HeaderReader(file, "/").read(file.root); }

bool has_member(const File& file, const Object& group, std::string_view name) {
  return find_link(file, group, name).has_value();
}

Object open_member(const File& file, const Object& group, std::string_view name) {
  const std::optional<Link> link = find_link(file, group, name);
  const std::string path = (group.path == "/" ? "/" : group.path + "/") + std::string(name);
  if (!link) damaged(file, "it has no object '" + path + "'");
  if (!link->hard) unsupported(file, "'" + path + "' is a link to elsewhere: store it directly");
  return HeaderReader(file, path).read(link->address);
}

}  // namespace rholm::hdf5
