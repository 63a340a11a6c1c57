#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "io/coefficients/test_support.h"
#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using namespace coefficients_testing;
using testing::read_all;
using testing::TemporaryFolder;

const CoefficientsReadOptions kOrthonormal = {.convention = {Normalization::kOrthonormal, 1}};

// Makes a file from the definition of the format (numpy.lib.format), independently of the writer.
std::string npy(const std::string& header, const std::string& data, int version = 1) {
  std::string bytes = "\x93NUMPY";
  bytes += {static_cast<char>(version), '\0'};
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) {
    bytes += static_cast<char>(header.size() >> (8 * i));
  }
  return bytes + header + data;
}

std::string header_of(const std::string& descr, const std::string& order = "False",
                      const std::string& shape = "(2, 2, 2)") {
  return "{'descr': '" + descr + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }  \n";
}

template <typename Number, typename Bits>
std::string numbers(const std::vector<Number>& values, bool big_endian) {
  std::string bytes;
  for (const Number value : values) {
    const auto bits = std::bit_cast<Bits>(value);
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
      bytes += static_cast<char>(bits >> 8 * (big_endian ? sizeof(Bits) - 1 - i : i));
    }
  }
  return bytes;
}

// C_00 = 1, C_10 = 2, C_11 = 3, S_11 = 4.
const std::vector<double> kPlain = {1, 0, 2, 3, 0, 0, 0, 4};
const std::vector<double> kFortran = {1, 0, 2, 0, 0, 0, 3, 4};

void expect_the_four(const std::string& bytes) {
  const CoefficientsFile file = parse(bytes, kOrthonormal);
  EXPECT_EQ(file.format, CoefficientsFormat::kNpy);
  const Coefficients& f = file.expansion.coefficients;
  ASSERT_EQ(f.degree(), 1);
  EXPECT_EQ(f.c(0, 0), 1);
  EXPECT_EQ(f.c(1, 0), 2);
  EXPECT_EQ(f.c(1, 1), 3);
  EXPECT_EQ(f.s(1, 1), 4);
}

TEST(npy, all_versions_types_orders_and_spellings_are_read) {
  const std::string little = numbers<double, std::uint64_t>(kPlain, false);
  for (const int version : {1, 2, 3}) expect_the_four(npy(header_of("<f8"), little, version));
  expect_the_four(npy(header_of(">f8"), numbers<double, std::uint64_t>(kPlain, true)));
  const std::vector<float> single(kPlain.begin(), kPlain.end());
  expect_the_four(npy(header_of("<f4"), numbers<float, std::uint32_t>(single, false)));
  expect_the_four(npy(header_of(">f4"), numbers<float, std::uint32_t>(single, true)));
  expect_the_four(npy(header_of("<f8", "True"), numbers<double, std::uint64_t>(kFortran, false)));
  expect_the_four(npy("{\"shape\":(2,2,2),\"fortran_order\":False,\"descr\":\"<f8\"}", little));
}

TEST(npy, written_file_is_what_numpy_writes) {
  const TemporaryFolder folder;
  Expansion expansion;
  expansion.coefficients = Coefficients(1);
  expansion.coefficients.c(0, 0) = 1;
  expansion.coefficients.c(1, 0) = 2;
  expansion.coefficients.c(1, 1) = 3;
  expansion.coefficients.s(1, 1) = 4;
  write_coefficients(expansion, folder / "a.npy",
                     {.format = {}, .convention = {Normalization::kOrthonormal, 1}});
  const std::string bytes = read_all(folder / "a.npy");
  // numpy.save (version 1.24) writes this array as 128 bytes and then the numbers.
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 2), }";
  header += std::string(128 - 10 - 1 - header.size(), ' ') + '\n';
  EXPECT_EQ(bytes, npy(header, numbers<double, std::uint64_t>(kPlain, false)));
}

TEST(npy, numbers_start_at_a_multiple_of_64_bytes_for_every_degree) {
  const TemporaryFolder folder;
  for (const int degree : {0, 9, 99, 999}) {
    Expansion expansion;
    expansion.coefficients = Coefficients(degree);
    write_coefficients(expansion, folder / "a.npy");
    const std::size_t data = 16 * (degree + std::size_t{1}) * (degree + std::size_t{1});
    const std::string bytes = read_all(folder / "a.npy");
    EXPECT_EQ((bytes.size() - data) % 64, 0u);
    EXPECT_EQ(bytes[bytes.size() - data - 1], '\n');
  }
}

TEST(npy, other_shapes_types_and_sizes_are_refused) {
  const std::string data = numbers<double, std::uint64_t>(kPlain, false);
  for (const std::string shape :
       {"()", "(8,)", "(2, 4)", "(1, 2, 2)", "(2, 2, 3)", "(2, 0, 0)", "(2, 2, 2, 1)",
        "(2, 16386, 16386)", "(2, 4294967296, 4294967296)", "(2, 3, 3)", "(2, 1, 1)"}) {
    expect_refused(npy(header_of("<f8", "False", shape), data), "");
  }
  expect_refused(npy(header_of("<f8"), data + "x"), "65 bytes");
  expect_refused(npy(header_of("<f8"), data.substr(1)), "63 bytes");
  expect_refused(npy(header_of("<f8", "False", "(2, 16385, 16385)"), data), "needs 4295491600");
  for (const std::string descr : {"<c16", "<i8", "|b1", "f8", "<f2", "|O", "=f8", "\xff\n"}) {
    if (descr.find('\n') != std::string::npos) continue;
    expect_unsupported(npy(header_of(descr), data), "");
  }
  expect_unsupported(npy("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (8,)}", data),
                     "named fields");
  expect_unsupported(npy(header_of("<f8"), data, 4), "version 4");
  std::vector<double> bad = kPlain;
  bad[3] = NAN;
  expect_refused(npy(header_of("<f8"), numbers<double, std::uint64_t>(bad, false)), "not finite");
  bad = kPlain;
  bad[1] = 1;
  expect_refused(npy(header_of("<f8"), numbers<double, std::uint64_t>(bad, false)), "m > l");
  bad = kPlain;
  bad[4] = 1;
  expect_refused(npy(header_of("<f8"), numbers<double, std::uint64_t>(bad, false)), "m = 0");
}

TEST(npy, malformed_headers_are_refused) {
  const std::string data = numbers<double, std::uint64_t>(kPlain, false);
  for (const std::string header :
       {"", "{}", "{", "x", "{'descr': '<f8'}", "{'descr': '<f8', 'shape': (2, 2, 2)}",
        "{'descr': '<f8', 'fortran_order': False}", "{'fortran_order': False, 'shape': (2,2,2)}",
        "{'descr': '<f8', 'fortran_order': Maybe, 'shape': (2, 2, 2)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 2)} x",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, -2, 2)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 99999999999999999999)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 2}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': [2, 2, 2]}",
        "{'descr': '<f8, 'fortran_order': False, 'shape': (2, 2, 2)}",
        "{'descr': '<f8', 'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 2)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 2), 'x': 1}",
        "{'descr' '<f8', 'fortran_order': False, 'shape': (2, 2, 2)}",
        "{'des\\x63r': '<f8', 'fortran_order': False, 'shape': (2, 2, 2)}"}) {
    expect_refused(npy(header, data), "header");
  }
  std::string many = "(";
  for (int i = 0; i < 100; ++i) many += "1,";
  expect_refused(npy(header_of("<f8", "False", many + ")"), data), "header");
  // The header claims a length that the file does not have.
  expect_refused(std::string("\x93NUMPY\x02\0\xff\xff\xff\xff{", 13), "ends within");
}

}  // namespace
}  // namespace rholm
