#include "io/hdf5/hdf5_values.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "io/hdf5/hdf5_bytes.h"
#include "io/hdf5/hdf5_messages.h"

namespace rholm::hdf5 {
namespace {

// Parses the bits of the class-dependent field and the properties of IEEE numbers that follow.
Type parse_float(const File& file, ByteReader& reader, std::uint32_t bits, std::uint32_t size) {
  struct Layout {
    std::uint32_t size, precision, exponent_at, exponent_bits, mantissa_bits, bias;
  };
  const std::uint32_t offset = reader.u16();
  Layout found = {};
  found.size = size;
  found.precision = reader.u16();
  found.exponent_at = reader.u8();
  found.exponent_bits = reader.u8();
  const std::uint32_t mantissa_at = reader.u8();
  found.mantissa_bits = reader.u8();
  found.bias = reader.u32();
  const bool sign_on_top = (bits >> 8 & 0xff) == found.precision - 1;
  const bool leading_bit_implied = (bits >> 4 & 3) == 2;
  for (const Layout& ieee : {Layout{8, 64, 52, 11, 52, 1023}, Layout{4, 32, 23, 8, 23, 127}}) {
    if (found.size == ieee.size && found.precision == ieee.precision &&
        found.exponent_at == ieee.exponent_at && found.exponent_bits == ieee.exponent_bits &&
        found.mantissa_bits == ieee.mantissa_bits && found.bias == ieee.bias && offset == 0 &&
        mantissa_at == 0 && sign_on_top && leading_bit_implied && (bits & 0x4e) == 0) {
      return {Kind::kFloat, size, (bits & 1) != 0, true};
    }
  }
  unsupported(file, "numbers other than IEEE float64 and float32");
}

Type parse_type(const File& file, std::string_view data) {
  ByteReader reader(file, data);
  const unsigned kind = reader.u8() & 0x0f;
  const auto bits = static_cast<std::uint32_t>(reader.number(3));
  const std::uint32_t size = reader.u32();
  constexpr unsigned kInteger = 0, kFloat = 1, kString = 3, kVariable = 9;
  if (size == 0) damaged(file, "a type of size 0");
  if (kind == kFloat) return parse_float(file, reader, bits, size);
  if (kind == kString) return {Kind::kFixedString, size};
  if (kind == kVariable && (bits & 0x0f) == 1 && size == 16) return {Kind::kVariableString, size};
  if (kind == kInteger && size <= 8 && reader.u16() == 0 && reader.u16() == 8 * size) {
    return {Kind::kInteger, size, (bits & 1) != 0, (bits & 8) != 0};
  }
  unsupported(file, "values other than whole integers, IEEE numbers and strings");
}

std::vector<std::uint64_t> parse_extents(const File& file, std::string_view data) {
  ByteReader reader(file, data);
  const unsigned version = reader.u8();
  const unsigned rank = reader.u8();
  reader.skip(1);
  if (version != 1 && version != 2) unsupported(file, "an HDF5 dataspace of an unknown version");
  constexpr unsigned kNull = 2;
  if (version == 2 && reader.u8() == kNull) unsupported(file, "an HDF5 array without values");
  if (version == 1) reader.skip(5);
  if (rank > 32) damaged(file, "an array of rank " + std::to_string(rank));  // HDF5's limit
  std::vector<std::uint64_t> extents(rank);
  for (std::uint64_t& extent : extents) extent = reader.u64();
  return extents;
}

// Returns the bytes of the array; throws InvalidInput if the file cannot hold them.
std::uint64_t size_of(const File& file, const Array& array) {
  std::uint64_t size = array.type.size;
  for (const std::uint64_t extent : array.extents) {
    if (extent != 0 && size > file.bytes.size() / extent) {
      damaged(file, "'" + array.path + "' is larger than the file");
    }
    size *= extent;
  }
  return size;
}

std::uint64_t count_of(const Array& array) { return array.data.size() / array.type.size; }

std::optional<Array> match_attribute(const File& file, const Object& object, std::string_view data,
                                     std::string_view name) {
  ByteReader reader(file, data);
  const unsigned version = reader.u8();
  if (version < 1 || version > 3) unsupported(file, "an HDF5 attribute of an unknown version");
  const unsigned flags = reader.u8();
  const unsigned name_size = reader.u16();
  const unsigned type_size = reader.u16();
  const unsigned space_size = reader.u16();
  if (version == 3) reader.skip(1);  // character set of the name
  const auto take = [&](std::uint64_t size) {
    const std::string_view taken = reader.take(size);
    if (version == 1) reader.skip((8 - size % 8) % 8);
    return taken;
  };
  const std::string_view stored_name = take(name_size);  // with a closing zero
  if (stored_name.substr(0, stored_name.find('\0')) != name) return std::nullopt;
  if (version > 1 && (flags & 3) != 0) unsupported(file, "an HDF5 attribute of a shared type");
  Array array{.path = object.path + "@" + std::string(name)};
  array.type = parse_type(file, take(type_size));
  array.extents = parse_extents(file, take(space_size));
  array.data = reader.take(size_of(file, array));
  return array;
}

std::string_view data_of(const File& file, const Array& array, std::string_view layout) {
  ByteReader reader(file, layout);
  const unsigned version = reader.u8();
  if (version != 3 && version != 4) unsupported(file, "an HDF5 layout of an unknown version");
  constexpr unsigned kCompact = 0, kContiguous = 1;
  const unsigned kind = reader.u8();
  const std::uint64_t needed = size_of(file, array);
  if (kind == kCompact) {
    const unsigned size = reader.u16();
    return ByteReader(file, reader.take(size)).take(needed);
  }
  if (kind != kContiguous) {
    unsupported(file, "'" + array.path + "' is stored in chunks: store it contiguous");
  }
  const std::uint64_t address = reader.u64();
  const std::uint64_t size = reader.u64();
  if (needed == 0 && address == kUndefined) return {};  // an empty array is not stored
  if (address == kUndefined || size != needed) {
    damaged(file, "the values of '" + array.path + "' are not all stored");
  }
  return bytes_at(file, address, size);
}

// Returns object `index` of the global heap's collection at `address`.
std::string_view heap_object(const File& file, std::uint64_t address, std::uint32_t index) {
  ByteReader head(file, bytes_from(file, address));
  head.expect("GCOL");
  head.skip(4);
  const std::uint64_t size = head.u64();
  ByteReader heap(file, bytes_at(file, address, size));
  heap.skip(16);
  while (heap.left() >= 16) {
    const std::uint32_t found = heap.u16();
    heap.skip(6);
    const std::uint64_t length = heap.u64();
    if (found == 0) break;  // the free space, last
    if (found == index) return heap.take(length);
    heap.skip(length);
    heap.skip(std::min<std::uint64_t>((8 - length % 8) % 8, heap.left()));
  }
  damaged(file, "a string is not where it must be");
}

std::uint64_t load(std::string_view bytes, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t place = big_endian ? bytes.size() - 1 - i : i;
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * place);
  }
  return value;
}

}  // namespace

std::optional<Array> find_attribute(const File& file, const Object& object, std::string_view name) {
  for (const Message& message : object.messages) {
    if (message.type == kAttributeMessage) {
      auto found = match_attribute(file, object, message.data, name);
      if (found) return found;
    } else if (message.type == kAttributeInfoMessage) {
      ByteReader info(file, message.data);
      info.skip(1);
      if ((info.u8() & 1) != 0) info.skip(2);
      if (info.u64() != kUndefined) {
        unsupported(file, "'" + object.path +
                              "' has many attributes, in HDF5's dense storage: with h5py, write "
                              "with libver='earliest'");
      }
    }
  }
  return std::nullopt;
}

Array read_dataset(const File& file, const Object& dataset) {
  Array array{.path = dataset.path};
  std::optional<std::string_view> type, space, layout;
  for (const Message& message : dataset.messages) {
    if (message.type == kDatatypeMessage) type = message.data;
    if (message.type == kDataspaceMessage) space = message.data;
    if (message.type == kLayoutMessage) layout = message.data;
    if (message.type == kFilterMessage || message.type == kExternalFilesMessage) {
      unsupported(file, "'" + array.path + "' is compressed or in another file: store it plainly");
    }
  }
  if (!type || !space || !layout) damaged(file, "'" + array.path + "' is not a dataset");
  array.type = parse_type(file, *type);
  array.extents = parse_extents(file, *space);
  array.data = data_of(file, array, *layout);
  return array;
}

std::string to_text(const File& file, const Array& array) {
  const bool variable = array.type.kind == Kind::kVariableString;
  if ((!variable && array.type.kind != Kind::kFixedString) || count_of(array) != 1) {
    damaged(file, "'" + array.path + "' must be one string");
  }
  std::string_view text = array.data;
  if (variable) {
    ByteReader reference(file, array.data);
    const std::uint32_t length = reference.u32();
    const std::uint64_t address = reference.u64();
    if (length == 0) return {};
    text = heap_object(file, address, reference.u32());
    if (length > text.size()) damaged(file, "the string '" + array.path + "' is not whole");
    text = text.substr(0, length);
  }
  return std::string(text.substr(0, text.find('\0')));
}

std::vector<std::string> to_texts(const File& file, const Array& array) {
  if (array.type.kind != Kind::kFixedString) {
    damaged(file, "'" + array.path + "' must be strings of one length");
  }
  std::vector<std::string> texts(count_of(array));
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::string_view text = array.data.substr(i * array.type.size, array.type.size);
    texts[i] = text.substr(0, text.find('\0'));
  }
  return texts;
}

std::vector<double> to_doubles(const File& file, const Array& array) {
  if (array.type.kind != Kind::kFloat) {
    damaged(file, "'" + array.path + "' must have floating point numbers");
  }
  std::vector<double> values(count_of(array));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t bits =
        load(array.data.substr(i * array.type.size, array.type.size), array.type.big_endian);
    values[i] = array.type.size == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                                     : std::bit_cast<double>(bits);
  }
  return values;
}

std::vector<std::int64_t> to_integers(const File& file, const Array& array) {
  if (array.type.kind != Kind::kInteger) damaged(file, "'" + array.path + "' must have integers");
  std::vector<std::int64_t> values(count_of(array));
  const unsigned unused = 64 - 8 * static_cast<unsigned>(array.type.size);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t bits =
        load(array.data.substr(i * array.type.size, array.type.size), array.type.big_endian);
    if (array.type.is_signed) {
      values[i] = static_cast<std::int64_t>(bits << unused) >> unused;
      continue;
    }
    if (bits > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      damaged(file, "'" + array.path + "' is too large");
    }
    values[i] = static_cast<std::int64_t>(bits);
  }
  return values;
}

std::int64_t to_integer(const File& file, const Array& array) {
  if (array.type.kind != Kind::kInteger || count_of(array) != 1) {
    damaged(file, "'" + array.path + "' must be one integer");
  }
  return to_integers(file, array).front();
}

}  // namespace rholm::hdf5
