// Our reader finds the values that were written, with the HDF5 library or without it.
#include "io/hdf5/hdf5_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "io/shapes/test_support.h"
#include "rholm/error.h"

// LeakSanitizer's, in builds that have it.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" __attribute__((weak)) void __lsan_disable();
extern "C" __attribute__((weak)) void __lsan_enable();
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace rholm::hdf5 {
namespace {

using rholm::testing::TemporaryFolder;

// Reads a written file and keeps its bytes.
struct Written {
  explicit Written(const std::filesystem::path& path)
      : bytes(rholm::testing::read_all(path)), file(open(bytes, "test")) {}
  Array attribute(const Object& object, const char* name) const {
    const auto found = find_attribute(file, object, name);
    EXPECT_TRUE(found.has_value()) << name;
    return found.value_or(Array{});
  }
  Array dataset(const Object& group, const char* name) const {
    return read_dataset(file, open_member(file, group, name));
  }
  std::string bytes;
  File file;
};

using Extents = std::vector<std::uint64_t>;

TEST(Hdf5Writer, attributes_of_every_kind_are_read_again) {
  const TemporaryFolder folder;
  const std::string long_text(70000, 'x');
  const std::vector<double> numbers = {1, -0.0, std::numeric_limits<double>::denorm_min(),
                                       std::numeric_limits<double>::infinity()};
  {
    Writer writer("test", (folder / "a.h5").string());
    writer.write_attribute(Writer::kRoot, "text", std::string("Grüße"));
    writer.write_attribute(Writer::kRoot, "empty", std::string());
    writer.write_attribute(Writer::kRoot, "long", long_text);
    writer.write_fixed_text(Writer::kRoot, "fixed", "kilometre");
    writer.write_fixed_text(Writer::kRoot, "fixed empty", "");
    const auto group = writer.create_group(Writer::kRoot, "group");
    writer.write_attribute(group, "int", -7);
    writer.write_attribute(group, "unsigned", std::uint32_t{4000000000U});
    writer.write_attribute(group, "double", 1.0 / 3);
    writer.write_attribute(group, "vector", Vec3{1, 2, 3});
    writer.write_attribute(group, "numbers", std::span<const double>(numbers));
    writer.write_attribute(group, "text", std::string("second"));
    writer.close();
  }
  const Written written(folder / "a.h5");
  const File& file = written.file;
  const hdf5::Object root = root_group(file), group = open_member(file, root, "group");
  EXPECT_EQ(to_text(file, written.attribute(root, "text")), "Grüße");
  EXPECT_EQ(to_text(file, written.attribute(root, "empty")), "");
  EXPECT_EQ(to_text(file, written.attribute(root, "long")), long_text);
  EXPECT_EQ(to_text(file, written.attribute(root, "fixed")), "kilometre");
  EXPECT_EQ(written.attribute(root, "fixed").type.kind, Kind::kFixedString);
  EXPECT_EQ(written.attribute(root, "fixed").type.size, 9u);
  EXPECT_EQ(to_text(file, written.attribute(root, "fixed empty")), "");
  EXPECT_EQ(to_text(file, written.attribute(group, "text")), "second");
  EXPECT_EQ(to_integer(file, written.attribute(group, "int")), -7);
  EXPECT_EQ(to_integer(file, written.attribute(group, "unsigned")), 4000000000);
  EXPECT_FALSE(written.attribute(group, "unsigned").type.is_signed);
  EXPECT_EQ(to_doubles(file, written.attribute(group, "double")), std::vector{1.0 / 3});
  EXPECT_TRUE(written.attribute(group, "double").extents.empty());
  EXPECT_EQ(to_doubles(file, written.attribute(group, "vector")), (std::vector<double>{1, 2, 3}));
  const std::vector<double> found = to_doubles(file, written.attribute(group, "numbers"));
  ASSERT_EQ(found.size(), numbers.size());
  EXPECT_EQ(std::memcmp(found.data(), numbers.data(), sizeof(double) * numbers.size()), 0);
}

template <typename T>
void expect_integers(const Written& written, const hdf5::Object& group, const char* name,
                     const Extents& extents, const std::vector<T>& values) {
  const Array array = written.dataset(group, name);
  EXPECT_EQ(array.extents, extents);
  EXPECT_EQ(array.type.size, sizeof(T));
  EXPECT_EQ(array.type.is_signed, std::is_signed_v<T>);
  EXPECT_EQ(to_integers(written.file, array),
            std::vector<std::int64_t>(values.begin(), values.end()));
}

TEST(Hdf5Writer, datasets_of_every_kind_are_read_again) {
  const TemporaryFolder folder;
  const std::vector<std::int8_t> bytes = {-1, 0, 1};
  const std::vector<std::uint8_t> unsigned_bytes = {0, 255};
  const std::vector<std::int16_t> shorts = {-32768, 32767, 5, 6};
  const std::vector<std::int64_t> wholes = {std::numeric_limits<std::int64_t>::min(), 9};
  std::vector<float> floats(24);
  std::iota(floats.begin(), floats.end(), 0.5F);
  const std::vector<double> doubles = {NAN, 1e300};
  const std::vector<std::string> texts = {"a", "", "three"};
  {
    Writer writer("test", (folder / "a.h5").string());
    const auto group = writer.create_group(Writer::kRoot, "g");
    const auto marked = writer.write_dataset(group, "bytes", Extents{3}, bytes.data());
    writer.write_dataset(group, "unsigned", Extents{2}, unsigned_bytes.data());
    writer.write_dataset(group, "shorts", Extents{2, 2}, shorts.data());
    writer.write_dataset(group, "wholes", Extents{2}, wholes.data());
    writer.write_dataset(group, "floats", Extents{2, 3, 4}, floats.data());
    writer.write_dataset(group, "doubles", Extents{2, 1}, doubles.data());
    writer.write_dataset(group, "none", Extents{0, 3}, doubles.data());
    writer.write_texts(group, "texts", texts);
    writer.write_attribute(marked, "mark", 1);
    writer.close();
  }
  const Written written(folder / "a.h5");
  const File& file = written.file;
  const hdf5::Object group = open_member(file, root_group(file), "g");
  expect_integers(written, group, "bytes", {3}, bytes);
  expect_integers(written, group, "unsigned", {2}, unsigned_bytes);
  expect_integers(written, group, "shorts", {2, 2}, shorts);
  expect_integers(written, group, "wholes", {2}, wholes);
  EXPECT_EQ(written.dataset(group, "floats").extents, (Extents{2, 3, 4}));
  EXPECT_EQ(to_doubles(file, written.dataset(group, "floats")),
            std::vector<double>(floats.begin(), floats.end()));
  EXPECT_TRUE(std::isnan(to_doubles(file, written.dataset(group, "doubles"))[0]));
  EXPECT_EQ(to_doubles(file, written.dataset(group, "doubles"))[1], 1e300);
  EXPECT_TRUE(to_doubles(file, written.dataset(group, "none")).empty());
  EXPECT_EQ(written.dataset(group, "none").extents, (Extents{0, 3}));
  EXPECT_EQ(to_texts(file, written.dataset(group, "texts")), texts);
  EXPECT_EQ(to_integer(file, *find_attribute(file, open_member(file, group, "bytes"), "mark")), 1);
}

TEST(Hdf5Writer, a_group_has_thousands_of_members) {
  const TemporaryFolder folder;
  constexpr std::size_t kMembers = 3000;
  {
    Writer writer("test", (folder / "a.h5").string(), kMembers);
    for (std::size_t k = 0; k < kMembers; ++k) {
      const auto value = static_cast<std::int64_t>(k);
      writer.write_dataset(Writer::kRoot, std::to_string(k).c_str(), Extents{1}, &value);
    }
    writer.close();
  }
  const Written written(folder / "a.h5");
  for (const int k : {0, 1, 2999}) {
    const Array array = written.dataset(root_group(written.file), std::to_string(k).c_str());
    EXPECT_EQ(to_integer(written.file, array), k);
  }
}

void expect_refused(ErrorCode code, const std::function<void()>& write) {
  try {
    write();
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(std::string(error.what()).find("test"), std::string::npos);
  }
}

// HDF5 1.10 leaks 152 bytes if it cannot close a file (a full disk). LeakSanitizer ignores memory
// that is allocated during the life of this object.
struct LeaksLeftOut {
  LeaksLeftOut() {
    if (__lsan_disable != nullptr) __lsan_disable();
  }
  ~LeaksLeftOut() {
    if (__lsan_enable != nullptr) __lsan_enable();
  }
  LeaksLeftOut(const LeaksLeftOut&) = delete;
  LeaksLeftOut& operator=(const LeaksLeftOut&) = delete;
};

TEST(Hdf5Writer, says_what_cannot_be_written) {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.h5").string();
  expect_refused(ErrorCode::kUnsupported, [&] { Writer("test", path, 65536); });
  expect_refused(ErrorCode::kIo, [&] { Writer("test", (folder / "none/a.h5").string()); });
  expect_refused(ErrorCode::kIo, [&] {
    Writer writer("test", path);
    writer.create_group(Writer::kRoot, "twice");
    writer.create_group(Writer::kRoot, "twice");
  });
  expect_refused(ErrorCode::kIo, [&] {
    const LeaksLeftOut left_out;
    Writer writer("test", "/dev/full");
    const std::vector<double> values(100000, 1);
    writer.write_dataset(Writer::kRoot, "values", Extents{values.size()}, values.data());
    writer.close();
  });
}

}  // namespace
}  // namespace rholm::hdf5
