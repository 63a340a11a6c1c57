#include "rholm/coefficients_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "io/coefficients/test_support.h"
#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using namespace coefficients_testing;
using testing::read_all;
using testing::TemporaryFolder;
using testing::write_all;

constexpr CoefficientsFormat kAllFormats[] = {CoefficientsFormat::kShtools,
                                              CoefficientsFormat::kIcgem, CoefficientsFormat::kJson,
                                              CoefficientsFormat::kNpy};
constexpr Convention kAllConventions[] = {
    {Normalization::kOrthonormal, 1}, {Normalization::kOrthonormal, -1},
    {Normalization::kFourPi, 1},      {Normalization::kFourPi, -1},
    {Normalization::kSchmidt, 1},     {Normalization::kSchmidt, -1}};

std::string written(const Expansion& expansion, CoefficientsFormat format,
                    const Convention& convention = {}) {
  const TemporaryFolder folder;
  write_coefficients(expansion, folder / "file", {.format = format, .convention = convention});
  return read_all(folder / "file");
}

void expect_same_or_neighbours(const Coefficients& a, const Coefficients& b) {
  ASSERT_EQ(a.degree(), b.degree());
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const double x = a.values()[i], y = b.values()[i];
    EXPECT_TRUE(x == y || y == std::nextafter(x, INFINITY) || y == std::nextafter(x, -INFINITY))
        << x << " " << y;
  }
}

// Numbers have the fewest digits that read back the same bits, so that a file loses nothing. A
// scale factor costs at most one unit in the last place (shown in the tests of conventions).
TEST(coefficients_io, round_trip_through_every_format_and_convention_keeps_everything) {
  for (const int degree : {0, 1, 2, 17}) {
    const Expansion expansion = random_expansion(degree);
    for (const CoefficientsFormat format : kAllFormats) {
      for (const Convention& convention : kAllConventions) {
        SCOPED_TRACE(std::string(to_string(format)) + " " + to_string(convention.normalization));
        const bool npy = format == CoefficientsFormat::kNpy;
        const CoefficientsFile file = parse(written(expansion, format, convention),
                                            {.convention = npy ? convention : Convention{}});
        EXPECT_EQ(file.format, format);
        EXPECT_EQ(file.convention, convention);
        if (convention.normalization == Normalization::kOrthonormal) {
          expect_same_numbers(file.expansion.coefficients, expansion.coefficients);
        } else {
          expect_same_or_neighbours(expansion.coefficients, file.expansion.coefficients);
        }
        if (npy) continue;
        expect_same_description(file.expansion, expansion);
        EXPECT_TRUE(file.assumed.empty());
      }
    }
  }
}

TEST(coefficients_io, numbers_at_the_ends_of_the_range_read_back_bit_by_bit) {
  Expansion expansion;
  expansion.coefficients = Coefficients(2);
  Coefficients& f = expansion.coefficients;
  f.c(0, 0) = std::numeric_limits<double>::max();
  f.c(1, 0) = std::numeric_limits<double>::denorm_min();
  f.c(1, 1) = -std::numeric_limits<double>::min();
  f.s(1, 1) = -0.0;
  f.c(2, 0) = 9007199254740993.0;
  f.c(2, 1) = 1e22;
  f.s(2, 2) = 0.1;
  for (const CoefficientsFormat format : kAllFormats) {
    const Convention convention{Normalization::kOrthonormal, 1};
    const CoefficientsFile file =
        parse(written(expansion, format, convention), {.convention = convention});
    const Coefficients& back = file.expansion.coefficients;
    for (std::size_t i = 0; i < f.values().size(); ++i) {
      EXPECT_EQ(back.values()[i], f.values()[i]) << to_string(format);
      EXPECT_EQ(std::signbit(back.values()[i]), std::signbit(f.values()[i])) << to_string(format);
    }
  }
}

TEST(coefficients_io, every_cut_is_noticed) {
  for (const CoefficientsFormat format : kAllFormats) {
    SCOPED_TRACE(to_string(format));
    const std::string bytes = written(random_expansion(3), format);
    // JSON is still complete without its last line end.
    const bool json = format == CoefficientsFormat::kJson;
    expect_every_cut_is_refused(bytes.substr(0, bytes.size() - (json ? 1 : 0)));
  }
}

TEST(coefficients_io, what_a_file_does_not_say_is_taken_from_the_options_and_listed) {
  const std::string bare = "0 0 2 0\n";
  const CoefficientsFile file = parse(bare);
  EXPECT_EQ(file.assumed, (std::vector<std::string>{"normalization 4pi", "csphase 1",
                                                    "function radius", "center 0 0 0"}));
  EXPECT_DOUBLE_EQ(file.expansion.coefficients.c(0, 0), 2 * std::sqrt(4 * std::numbers::pi));

  const Convention orthonormal{Normalization::kOrthonormal, -1};
  const CoefficientsFile other = parse(bare, {.convention = orthonormal});
  EXPECT_EQ(other.convention, orthonormal);
  EXPECT_EQ(other.expansion.coefficients.c(0, 0), 2);
  EXPECT_EQ(other.assumed[0], "normalization orthonormal");
}

TEST(coefficients_io, what_a_file_says_wins_unless_overridden) {
  const std::string text = "# normalization: schmidt\n# csphase: -1\n1 1 2 0\n";
  const Convention orthonormal{Normalization::kOrthonormal, 1};
  EXPECT_EQ(parse(text, {.convention = orthonormal}).convention,
            (Convention{Normalization::kSchmidt, -1}));
  const CoefficientsFile forced = parse(text, {.convention = orthonormal, .override_file = true});
  EXPECT_EQ(forced.convention, orthonormal);
  EXPECT_EQ(forced.expansion.coefficients.c(1, 1), 2);
}

TEST(coefficients_io, content_decides_the_format_and_the_extension_that_of_the_output) {
  const TemporaryFolder folder;
  const Expansion expansion = random_expansion(2);
  const std::pair<const char*, CoefficientsFormat> names[] = {
      {"a.sh", CoefficientsFormat::kShtools},      {"a.txt", CoefficientsFormat::kShtools},
      {"a.shtools", CoefficientsFormat::kShtools}, {"a.gfc", CoefficientsFormat::kIcgem},
      {"a.icgem", CoefficientsFormat::kIcgem},     {"a.json", CoefficientsFormat::kJson},
      {"a.npy", CoefficientsFormat::kNpy},         {"A.JSON", CoefficientsFormat::kJson}};
  for (const auto& [name, format] : names) {
    EXPECT_EQ(coefficients_format_of(name), format);
    write_coefficients(expansion, folder / name);
    std::filesystem::rename(folder / name, folder / "renamed.xyz");
    EXPECT_EQ(read_coefficients(folder / "renamed.xyz").format, format) << name;
  }
  EXPECT_EQ(coefficients_format_of("a"), std::nullopt);
  EXPECT_EQ(coefficients_format_of("a.h5"), std::nullopt);
  EXPECT_EQ(error_code([&] { write_coefficients(expansion, folder / "a.dat"); }, ".json"),
            ErrorCode::kUnsupported);
}

TEST(coefficients_io, looks_like_coefficients_knows_its_own_files_but_not_bare_text) {
  for (const CoefficientsFormat format : kAllFormats) {
    const std::string bytes = written(random_expansion(1), format);
    EXPECT_TRUE(looks_like_coefficients(bytes)) << to_string(format);
  }
  for (const std::string bytes :
       {"", "0 0 1 0\n", "1.5 2 3\n", "ply\nformat ascii 1.0\n", "OFF\n1 0 0\n", "{}",
        "{\"asset\":{\"version\":\"2.0\"}}", "# a comment\n0 0 1 0\n", "solid gfc\n"}) {
    EXPECT_FALSE(looks_like_coefficients(bytes)) << bytes;
  }
}

TEST(coefficients_io, format_names_read_back) {
  for (const CoefficientsFormat format : kAllFormats) {
    EXPECT_EQ(parse_coefficients_format(to_string(format)), format);
  }
  EXPECT_EQ(error_code([] { parse_coefficients_format("h5"); }, "'h5'"), ErrorCode::kUnsupported);
}

TEST(coefficients_io, expansions_that_are_not_whole_are_not_written) {
  const TemporaryFolder folder;
  const auto expect_not_written = [&](const std::string& words, auto spoil) {
    for (const CoefficientsFormat format : kAllFormats) {
      Expansion expansion = random_expansion(2);
      spoil(expansion);
      EXPECT_EQ(error_code([&] { write_coefficients(expansion, folder / "f", {.format = format}); },
                           words),
                ErrorCode::kInvalidInput);
    }
  };
  expect_not_written("not finite", [](Expansion& e) { e.coefficients.c(1, 1) = NAN; });
  expect_not_written("not finite", [](Expansion& e) { e.coefficients.s(2, 1) = -INFINITY; });
  expect_not_written("m > l", [](Expansion& e) { e.coefficients.values()[1] = 1; });
  expect_not_written("m = 0", [](Expansion& e) { e.coefficients.s(1, 0) = 1; });
  expect_not_written("center", [](Expansion& e) { e.center.y = NAN; });
  expect_not_written("norm_squared", [](Expansion& e) { e.norm_squared = -1; });
  expect_not_written("tail_strength", [](Expansion& e) { e.tail_strength = INFINITY; });
  expect_not_written("unit", [](Expansion& e) { e.unit = "km\n0 0 1 0"; });
  expect_not_written("unit", [](Expansion& e) { e.unit = " km"; });
  expect_not_written("unit", [](Expansion& e) { e.unit = std::string(257, 'k'); });
  for (const std::string bad : {"\xff", "\xc3", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80",
                                "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\x7f"}) {
    expect_not_written("method", [&](Expansion& e) { e.method = bad; });
  }
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(coefficients_io, every_plane_of_unicode_is_a_unit) {
  for (const std::string good : {"\xc2\xb5m", "\xe2\x82\xac", "\xed\x9f\xbf", "\xee\x80\x80",
                                 "\xf0\x9f\x98\x80", "\xf4\x8f\xbf\xbf"}) {
    Expansion expansion = random_expansion(0);
    expansion.unit = good;
    for (const CoefficientsFormat format :
         {CoefficientsFormat::kShtools, CoefficientsFormat::kIcgem, CoefficientsFormat::kJson}) {
      EXPECT_EQ(parse(written(expansion, format)).expansion.unit, good);
    }
  }
}

// Schmidt's coefficients exceed the orthonormal ones from degree 6 on: (2l + 1) > 4 pi.
TEST(coefficients_io, overflow_in_another_convention_is_refused_not_written_as_infinity) {
  Expansion expansion;
  expansion.coefficients = Coefficients(8);
  expansion.coefficients.c(8, 3) = 1.7e308;
  EXPECT_EQ(error_code(
                [&] {
                  written(expansion, CoefficientsFormat::kJson, {Normalization::kSchmidt, 1});
                },
                "not finite"),
            ErrorCode::kInvalidInput);
  expect_refused("0 0 1e308\n", "not finite");
}

TEST(coefficients_io, missing_files_folders_and_empty_files_are_refused) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_code([&] { read_coefficients(folder / "none"); }, "none"), ErrorCode::kIo);
  EXPECT_EQ(error_code([&] { read_coefficients(folder.path()); }), ErrorCode::kIo);
  write_all(folder / "empty", "");
  EXPECT_EQ(error_code([&] { read_coefficients(folder / "empty"); }, "empty"),
            ErrorCode::kInvalidInput);
  EXPECT_EQ(error_code([&] { write_coefficients(random_expansion(1), folder / "no/a.sh"); }),
            ErrorCode::kIo);
}

TEST(coefficients_io, byte_order_mark_is_passed_over) {
  for (const CoefficientsFormat format :
       {CoefficientsFormat::kShtools, CoefficientsFormat::kIcgem, CoefficientsFormat::kJson}) {
    const Expansion expansion = random_expansion(1);
    const std::string bytes =
        "\xef\xbb\xbf" + written(expansion, format, {Normalization::kOrthonormal, 1});
    EXPECT_TRUE(looks_like_coefficients(bytes));
    expect_same_numbers(parse(bytes).expansion.coefficients, expansion.coefficients);
  }
}

}  // namespace
}  // namespace rholm
