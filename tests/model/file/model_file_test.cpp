#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "base/crc32.h"
#include "io/coefficients/test_support.h"
#include "io/hdf5/hdf5_bytes.h"
#include "io/shapes/test_support.h"
#include "model/file/model_read.h"
#include "rholm/model.h"
#include "rholm/rholm.h"

namespace rholm {
namespace {

using coefficients_testing::error_code;
using coefficients_testing::expect_same_description;
using coefficients_testing::expect_same_numbers;
using coefficients_testing::random_expansion;
using testing::read_all;
using testing::TemporaryFolder;
using testing::write_all;

std::string model_bytes(const Expansion& expansion) {
  const TemporaryFolder folder;
  write_model(expansion, folder / "a.h5");
  return read_all(folder / "a.h5");
}

void expect_model_refused(const std::string& bytes, ErrorCode code, const std::string& words) {
  EXPECT_EQ(error_code([&] { parse_model(bytes, "test"); }, words), code);
}

bool same_bits(const Coefficients& a, const Coefficients& b) {
  return a.degree() == b.degree() &&
         std::equal(a.values().begin(), a.values().end(), b.values().begin(),
                    [](double x, double y) {
                      return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
                    });
}

TEST(model_file, round_trip_keeps_every_bit) {
  for (const int degree : {0, 1, 5, 64}) {
    Expansion expansion = random_expansion(degree);
    expansion.coefficients.c(0, 0) = std::numeric_limits<double>::denorm_min();
    if (degree > 0) expansion.coefficients.s(1, 1) = -0.0;
    const Expansion back = parse_model(model_bytes(expansion), "test");
    EXPECT_TRUE(same_bits(back.coefficients, expansion.coefficients));
    expect_same_description(back, expansion);
  }
  Expansion field = random_expansion(3);
  field.function = RadialFunction::kOther;
  field.gravity = {3.986004415e14, 6378136.3};
  expect_same_description(parse_model(model_bytes(field), "test"), field);
  Expansion plain;
  const Expansion back = parse_model(model_bytes(plain), "test");
  expect_same_description(back, plain);
}

// The HDF5 library may be built without support for threads.
TEST(model_file, several_threads_write_at_once) {
  const Expansion expansion = random_expansion(9);
  const std::string expected = model_bytes(expansion);  // also uses a folder of this test
  const TemporaryFolder folder;
  std::vector<std::jthread> threads;
  threads.reserve(4);
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      const std::string name = std::to_string(i) + ".h5";
      for (int k = 0; k < 50; ++k) {
        write_model(expansion, folder / name.c_str());
        EXPECT_EQ(read_all(folder / name.c_str()), expected);
      }
    });
  }
}

TEST(model_file, same_expansion_gives_the_same_bytes) {
  const std::string bytes = model_bytes(random_expansion(7));
  EXPECT_EQ(bytes, model_bytes(random_expansion(7)));
  // Bit 5 of the flags of an object header says that the object has times.
  std::size_t n_headers = 0;
  for (std::size_t at = 0; (at = bytes.find("OHDR\2", at)) != std::string::npos;
       ++at, ++n_headers) {
    EXPECT_EQ(bytes[at + 5] & 0x20, 0);
  }
  EXPECT_EQ(n_headers, 3u);
}

TEST(model_file, errors_return_and_those_that_are_unknown_stay_unknown) {
  Expansion expansion = random_expansion(3);
  expansion.errors = TruncationErrors{};
  expansion.errors->rms = 0.25;
  expansion.errors->rms_is_exact = true;
  expansion.errors->measured_max = 1.5;
  expansion.errors->max_bound = 1.75;
  expansion.errors->distance_rms = 0.125;
  expansion.errors->distances_are_closest = true;
  expansion.errors->points = 1234567;
  expansion.errors->diagonal = 3.5;
  const TemporaryFolder folder;
  write_model(expansion, folder / "a.h5");
  const Expansion again = read_model(folder / "a.h5");
  ASSERT_TRUE(again.errors.has_value());
  EXPECT_EQ(again.errors->rms, 0.25);
  EXPECT_TRUE(again.errors->rms_is_exact);
  EXPECT_EQ(again.errors->measured_max, 1.5);
  EXPECT_EQ(again.errors->max_bound, 1.75);
  EXPECT_EQ(again.errors->distance_rms, 0.125);
  EXPECT_TRUE(again.errors->distances_are_closest);
  EXPECT_EQ(again.errors->points, 1234567u);
  EXPECT_EQ(again.errors->diagonal, 3.5);
  EXPECT_FALSE(again.errors->predicted_max.has_value());
  EXPECT_FALSE(again.errors->measured_max_distance.has_value());
  expansion.errors->rms = -1;
  write_model(expansion, folder / "b.h5");
  EXPECT_THROW(read_model(folder / "b.h5"), Error);
  expansion.errors.reset();
  write_model(expansion, folder / "c.h5");
  EXPECT_FALSE(read_model(folder / "c.h5").errors.has_value());
}

// Checks the values of the formulas C_lm = 1/(1 + l + m), S_lm = m/(l + 1).
void expect_golden(const Expansion& expansion) {
  ASSERT_EQ(expansion.coefficients.degree(), 4);
  for (int l = 0; l <= 4; ++l) {
    for (int m = 0; m <= l; ++m) {
      EXPECT_EQ(expansion.coefficients.c(l, m), 1.0 / (1 + l + m));
      EXPECT_EQ(expansion.coefficients.s(l, m), m / (l + 1.0));
    }
  }
  EXPECT_EQ(expansion.function, RadialFunction::kGauge);
  EXPECT_EQ(expansion.center, (Vec3{1, -2, 0.5}));
  EXPECT_EQ(expansion.unit, "\xc2\xb5m");
  EXPECT_EQ(expansion.method, "gauge");
  EXPECT_EQ(expansion.norm_squared, 12.5);
  EXPECT_EQ(expansion.tail_strength, 0.125);
}

// Every later version must read these files. The first is of version 0.1.0; h5py 3.7 wrote the
// others with its default, the oldest and the newest format of HDF5.
TEST(model_file, golden_files_of_version_0_1_are_read) {
  const std::filesystem::path folder = RHOLM_TEST_DATA;
  for (const char* name : {"degree4.h5", "degree4-h5py-default.h5", "degree4-h5py-latest.h5"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(is_model_file(folder / name));
    expect_golden(read_model(folder / name));
    const CoefficientsFile any = read_any_coefficients(folder / name);
    expect_golden(any.expansion);
    EXPECT_EQ(any.convention, (Convention{Normalization::kOrthonormal, 1}));
  }
}

// HDF5's own checksums protect its metadata, and crc32 protects the other bytes. A flipped bit is
// detected, or it is in a byte without meaning.
TEST(model_file, every_flipped_bit_is_refused_or_changes_nothing) {
  const Expansion expansion = random_expansion(2);
  const std::string whole = model_bytes(expansion);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(bytes[i] ^ (1 << bit));
      try {
        const Expansion back = parse_model(bytes, "test");
        EXPECT_TRUE(same_bits(back.coefficients, expansion.coefficients)) << i;
        expect_same_description(back, expansion);
      } catch (const Error& error) {
        EXPECT_NE(error.code(), ErrorCode::kIo);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 8u * 1000);  // superblock, headers, coefficients and strings
}

TEST(model_file, every_cut_is_refused) {
  const std::filesystem::path folder = RHOLM_TEST_DATA;
  for (const char* name : {"degree4.h5", "degree4-h5py-default.h5", "degree4-h5py-latest.h5"}) {
    const std::string whole = read_all(folder / name);
    ASSERT_FALSE(whole.empty());
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_THROW(parse_model({whole.data(), size}, "test"), Error) << size;
    }
  }
}

// Files that h5py can write, and that are not models or not models of this version.
TEST(model_file, other_hdf5_files_are_refused_with_their_reason) {
  const std::filesystem::path folder = std::filesystem::path(RHOLM_TEST_DATA) / "refused";
  const struct {
    const char* name;
    ErrorCode code;
    const char* words;
  } files[] = {
      {"empty.h5", ErrorCode::kUnsupported, "not a model"},
      {"other-format.h5", ErrorCode::kUnsupported, "not a model"},
      {"version-2.h5", ErrorCode::kUnsupported, "version 2"},
      {"version-text.h5", ErrorCode::kInvalidInput, "version_major"},
      {"no-expansion.h5", ErrorCode::kInvalidInput, "expansion"},
      {"no-coefficients.h5", ErrorCode::kInvalidInput, "coefficients"},
      {"group-as-coefficients.h5", ErrorCode::kInvalidInput, "coefficients"},
      {"dataset-as-expansion.h5", ErrorCode::kInvalidInput, "expansion"},
      {"soft-link.h5", ErrorCode::kUnsupported, "link"},
      {"external-link.h5", ErrorCode::kUnsupported, "link"},
      {"chunked.h5", ErrorCode::kUnsupported, "compressed"},
      {"chunked-plain.h5", ErrorCode::kUnsupported, "chunks"},
      {"external-file.h5", ErrorCode::kUnsupported, "another file"},
      {"int64.h5", ErrorCode::kInvalidInput, "floating"},
      {"float16.h5", ErrorCode::kUnsupported, "IEEE"},
      {"complex.h5", ErrorCode::kUnsupported, "values other"},
      {"rank-2.h5", ErrorCode::kInvalidInput, "shape"},
      {"not-square.h5", ErrorCode::kInvalidInput, "shape"},
      {"no-degree.h5", ErrorCode::kInvalidInput, "degree"},
      {"empty-array.h5", ErrorCode::kInvalidInput, "(2, 0, 0)"},
      {"wrong-degree.h5", ErrorCode::kInvalidInput, "degree 3"},
      {"nan.h5", ErrorCode::kInvalidInput, "not finite"},
      {"above-diagonal.h5", ErrorCode::kInvalidInput, "m > l"},
      {"schmidt.h5", ErrorCode::kUnsupported, "schmidt"},
      {"csphase.h5", ErrorCode::kUnsupported, "csphase"},
      {"function.h5", ErrorCode::kInvalidInput, "function"},
      {"center-2.h5", ErrorCode::kInvalidInput, "center"},
      {"center-text.h5", ErrorCode::kInvalidInput, "center"},
      {"crc32.h5", ErrorCode::kInvalidInput, "checksum"},
      {"dense-attributes.h5", ErrorCode::kUnsupported, "many attributes"},
      {"dense-links.h5", ErrorCode::kUnsupported, "many members"},
      {"committed-type.h5", ErrorCode::kUnsupported, "shared"},
      {"user-block.h5", ErrorCode::kInvalidInput, "not an HDF5 file"},
      {"unit-bytes.h5", ErrorCode::kInvalidInput, "unit"},
  };
  for (const auto& [name, code, words] : files) {
    SCOPED_TRACE(name);
    const std::string bytes = read_all(folder / name);
    ASSERT_FALSE(bytes.empty());
    expect_model_refused(bytes, code, words);
  }
}

// Files that are models: other types for the same values, more members, old and new storage.
TEST(model_file, variants_that_mean_the_same_are_read) {
  const std::filesystem::path folder = std::filesystem::path(RHOLM_TEST_DATA) / "accepted";
  std::size_t n_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().string());
    const Expansion expansion = read_model(entry.path());
    ASSERT_EQ(expansion.coefficients.degree(), 1);
    EXPECT_EQ(expansion.coefficients.c(0, 0), 1);
    EXPECT_EQ(expansion.coefficients.c(1, 0), 2);
    EXPECT_EQ(expansion.coefficients.c(1, 1), 3);
    EXPECT_EQ(expansion.coefficients.s(1, 1), 4);
    ++n_files;
  }
  EXPECT_EQ(n_files, 7u);
}

// The oldest format has no checksums. Every place that can hold an address, size or count gets
// values that point outside the file, to the place itself, or overflow a sum or product. The answer
// must be an Error or a valid expansion, without delay; sanitizers find other faults.
TEST(model_file, hostile_addresses_and_sizes_are_answered_safely) {
  const std::filesystem::path folder = RHOLM_TEST_DATA;
  const std::string whole = read_all(folder / "degree4-h5py-default.h5");
  ASSERT_FALSE(whole.empty());
  const std::uint64_t size = whole.size();
  std::size_t refused = 0;
  for (std::size_t at = 0; at + 8 <= size; ++at) {
    for (const std::uint64_t word : {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{at}, size,
                                     size - 1, std::uint64_t{1} << 63, std::uint64_t{1} << 61,
                                     ~std::uint64_t{0} - at, std::uint64_t{0x100010001}}) {
      std::string bytes = whole;
      for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<char>(word >> (8 * i));
      try {
        const Expansion expansion = parse_model(bytes, "test");
        for (const double value : expansion.coefficients.values()) {
          ASSERT_TRUE(std::isfinite(value)) << at << " " << word;
        }
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 1000u);
}

void put(std::string& bytes, std::size_t at, std::uint64_t word, std::size_t size = 8) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(word >> (8 * i));
}

TEST(model_file, sizes_that_do_not_fit_are_named) {
  const std::string whole =
      read_all(std::filesystem::path(RHOLM_TEST_DATA) / "degree4-h5py-default.h5");
  expect_model_refused(whole.substr(0, whole.size() - 1), ErrorCode::kInvalidInput, "cut off");

  // The extents 2, 5, 5 of the coefficients become 2, 2^32, 2^32: their product is 0 in 64 bits.
  std::string extents(24, '\0');
  put(extents, 0, 2), put(extents, 8, 5), put(extents, 16, 5);
  const std::size_t extents_at = whole.find(extents);
  ASSERT_NE(extents_at, std::string::npos);
  std::string bytes = whole;
  put(bytes, extents_at + 8, std::uint64_t{1} << 32);
  put(bytes, extents_at + 16, std::uint64_t{1} << 32);
  expect_model_refused(bytes, ErrorCode::kInvalidInput, "larger than the file");

  // The unit has 3 bytes in the heap of strings and claims 300.
  std::string reference(12, '\0');
  put(reference, 0, 3, 4), put(reference, 4, whole.find("GCOL"));
  const std::size_t reference_at = whole.find(reference);
  ASSERT_NE(reference_at, std::string::npos);
  bytes = whole;
  put(bytes, reference_at, 300, 4);
  expect_model_refused(bytes, ErrorCode::kInvalidInput, "not whole");
}

// A continuation of an object header that points to itself, and a tree that is its own child. The
// zeros at the end allow deep recursion if nothing limits it.
TEST(model_file, circles_end) {
  const std::filesystem::path folder = RHOLM_TEST_DATA;
  const std::string whole =
      read_all(folder / "degree4-h5py-default.h5") + std::string(std::size_t{1} << 26, '\0');
  std::size_t n_circles = 0;
  // Type 16, 16 bytes, no flags; then follow the address and the size of the block.
  const std::string continuation("\x10\0\x10\0\0\0\0\0", 8);
  for (std::size_t at = 0; (at = whole.find(continuation, at)) != std::string::npos; ++at) {
    std::string bytes = whole;
    put(bytes, at + 8, at);
    put(bytes, at + 16, 24);
    EXPECT_THROW(parse_model(bytes, "test"), Error);
    ++n_circles;
  }
  for (std::size_t at = 0; (at = whole.find("TREE", at)) != std::string::npos; ++at) {
    for (const char level : {'\0', '\1', '\7', '\xff'}) {
      std::string bytes = whole;
      bytes[at + 5] = level;
      put(bytes, at + 32, at);
      EXPECT_THROW(parse_model(bytes, "test"), Error);
      ++n_circles;
    }
  }
  EXPECT_GE(n_circles, 1u + 2 * 4);

  // The newer object header has a signature, a message of 16 bytes, a filler message and a
  // checksum.
  std::string bytes = read_all(folder / "degree4.h5");
  const std::size_t at = bytes.find("OCHK");
  const std::size_t end = bytes.find("OHDR", at);
  ASSERT_NE(end, std::string::npos);
  const std::size_t filler = at + 4 + 4 + 16;
  put(bytes, at + 4, 0x10 | 16 << 8, 4);
  put(bytes, at + 8, at);
  put(bytes, at + 16, end - at);
  put(bytes, filler, (end - 4 - filler - 4) << 8, 4);
  put(bytes, end - 4, hdf5::lookup3(std::string_view(bytes).substr(at, end - 4 - at)), 4);
  expect_model_refused(bytes, ErrorCode::kInvalidInput, "no end");
}

TEST(model_file, writing_refuses_what_cannot_be_read_and_leaves_the_old_file) {
  const TemporaryFolder folder;
  write_all(folder / "a.h5", "old");
  Expansion expansion = random_expansion(2);
  expansion.coefficients.c(1, 0) = NAN;
  EXPECT_EQ(error_code([&] { write_model(expansion, folder / "a.h5"); }, "not finite"),
            ErrorCode::kInvalidInput);
  EXPECT_EQ(read_all(folder / "a.h5"), "old");
  expansion = random_expansion(2);
  EXPECT_EQ(error_code([&] { write_model(expansion, folder / "none/a.h5"); }), ErrorCode::kIo);
  EXPECT_EQ(error_code([&] { write_model(expansion, "-"); }, "json"), ErrorCode::kUnsupported);
  EXPECT_EQ(error_code([&] { write_model(expansion, "/dev/null"); }), ErrorCode::kUnsupported);
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(model_file, read_any_coefficients_tells_models_from_texts_by_content) {
  const TemporaryFolder folder;
  const Expansion expansion = random_expansion(3);
  write_model(expansion, folder / "model.sh");
  write_coefficients(
      expansion, folder / "text.h5",
      {.format = CoefficientsFormat::kShtools, .convention = {Normalization::kOrthonormal, 1}});
  EXPECT_TRUE(is_model_file(folder / "model.sh"));
  EXPECT_FALSE(is_model_file(folder / "text.h5"));
  for (const char* name : {"model.sh", "text.h5"}) {
    const CoefficientsFile file = read_any_coefficients(folder / name);
    expect_same_numbers(file.expansion.coefficients, expansion.coefficients);
    expect_same_description(file.expansion, expansion);
  }
  EXPECT_EQ(error_code([&] { read_model(folder / "text.h5"); }, "not an HDF5 file"),
            ErrorCode::kInvalidInput);
  EXPECT_EQ(error_code([&] { read_model(folder / "none"); }), ErrorCode::kIo);
  EXPECT_EQ(error_code([&] { is_model_file(folder / "none"); }), ErrorCode::kIo);
  EXPECT_FALSE(is_model_file("-"));
}

// Check values: RFC 3720 and zlib for "123456789"; lookup3.c prints 17770551 for this text.
TEST(checksums, have_their_published_check_values) {
  EXPECT_EQ(crc32("123456789"), 0xcbf43926U);
  EXPECT_EQ(crc32("6789", crc32("12345")), 0xcbf43926U);
  EXPECT_EQ(crc32(""), 0U);
  EXPECT_EQ(hdf5::lookup3("Four score and seven years ago"), 0x17770551U);
  EXPECT_EQ(hdf5::lookup3(""), 0xdeadbeefU);
}

}  // namespace
}  // namespace rholm
