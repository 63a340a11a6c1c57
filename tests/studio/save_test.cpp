// Saved files have the same bytes as files of the library, and can be opened again.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "rholm/coefficients_io.h"
#include "rholm/compress.h"
#include "rholm/file.h"
#include "rholm/filter.h"
#include "rholm/model.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/render.h"
#include "rholm/shape_io.h"
#include "rholm/synthesize.h"
#include "studio/client.h"
#include "studio/recipe.h"

namespace rholm::studio {
namespace {

using test::Client;

// Returns the bytes that a function writes to a file of that name.
template <typename Write>
std::string bytes_of(const std::string& name, const Write& write) {
  const auto path = std::filesystem::path(::testing::TempDir()) / ("studio-save-" + name);
  write(path);
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  return bytes;
}

Expansion bumpy_expansion() {
  ExpandOptions options;
  options.degree = 8;
  return expand(bumpy_sphere(5), options).transform.expansion;
}

TEST(Save, ShapesAreThoseOfTheLibrary) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "make"}, {"shape", "points"}});
  const Mesh mesh = bumpy_sphere(5);
  const PointCloud points = sample_surface(mesh, {.points = 20000});
  for (const char* const name : {"ply", "obj", "off", "stl"}) {
    const std::string format = name;
    const Response answer = client.save(1, format);
    EXPECT_EQ(answer.download, "bumpy." + format);
    EXPECT_TRUE(answer.body ==
                bytes_of("a." + format, [&](const auto& path) { write_shape(mesh, path); }))
        << format;
  }
  for (const char* const name : {"ply", "xyz"}) {
    const std::string format = name;
    EXPECT_TRUE(client.save(2, format).body ==
                bytes_of("a." + format, [&](const auto& path) { write_shape(points, path); }))
        << format;
  }
}

TEST(Save, CoefficientsAreThoseOfTheLibrary) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "expand"}, {"item", 1}, {"degree", 8}});
  const Expansion expansion = bumpy_expansion();
  EXPECT_TRUE(client.save(1, "h5").body ==
              bytes_of("a.h5", [&](const auto& path) { write_model(expansion, path); }));
  for (const auto& [format, name] :
       std::vector<std::pair<std::string, std::string>>{{"json", "a.json"},
                                                        {"npy", "a.npy"},
                                                        {"shtools", "a.sh"},
                                                        {"icgem", "a.gfc"},
                                                        {"txt", "a.txt"}}) {
    const Response answer = client.save(1, format);
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_TRUE(answer.body ==
                bytes_of(name, [&](const auto& path) { write_coefficients(expansion, path); }))
        << format;
  }
  // The file contains the truncated model that is shown.
  client.step({{"op", "look"}, {"item", 1}, {"degree", 3}});
  const Expansion cut =
      filter(expansion, low_pass(3, 8, {.window = Window::kIdeal}), "low-pass 3 ideal");
  EXPECT_TRUE(client.save(1, "h5").body ==
              bytes_of("a.h5", [&](const auto& path) { write_model(cut, path); }));
  const int degree = 3;
  const Mesh sphere = directions_of(bumpy_sphere(5), expansion.center);
  const Mesh surface = synthesize(expansion, sphere, std::span(&degree, 1)).front();
  EXPECT_TRUE(client.save(1, "ply").body ==
              bytes_of("a.ply", [&](const auto& path) { write_shape(surface, path); }));
}

TEST(Save, PicturesAreThoseOfTheLibrary) {
  Client client;
  client.step({{"op", "make"}, {"shape", "box"}});
  const Mesh mesh = box({1, 1, 1}, 24);
  const Panel panel = {.mesh = &mesh};
  const std::vector<char> png =
      encode_png(render(std::span(&panel, 1), {.width = 64, .height = 48}));
  const Response answer = client.save(1, "png", "64x48");
  EXPECT_EQ(answer.type, "image/png");
  EXPECT_TRUE(answer.body == std::string(png.begin(), png.end()));
  for (const char* size :
       {"64", "x", "64x", "64x48x3", "-1x20", "axb", "99999999999x2", "64x48 "}) {
    const int status = client.save(1, "png", size).status;
    EXPECT_TRUE(status == 400 || status == 422) << size << status;
  }
}

TEST(Save, WhatAKindHasNotIsRefused) {
  Client client;
  client.step({{"op", "make"}, {"shape", "box"}});
  client.step({{"op", "make"}, {"shape", "points"}});
  for (const auto& [item, format] : std::vector<std::pair<int, std::string>>{
           {1, "h5"}, {1, "json"}, {1, "xyz"}, {1, ""}, {1, "../x"}, {2, "stl"}, {2, "h5"}}) {
    EXPECT_EQ(client.save(item, format).status, 400) << item << format;
  }
  EXPECT_EQ(client.save(1, "html").status, 422);
  EXPECT_EQ(client.save(9, "ply").status, 404);
}

TEST(Save, ReportsAreWholePages) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "expand"}, {"item", 1}, {"degree", 4}});
  const Response answer = client.save(1, "html");
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_EQ(answer.type, "text/html");
  EXPECT_NE(answer.body.find("</html>"), std::string::npos);
  EXPECT_NE(answer.body.find("rholm expand bumpy.ply --degree 4 -o bumpy.h5"), std::string::npos);
}

TEST(Save, EveryFileOpensAgain) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "expand"}, {"item", 1}, {"degree", 8}});
  client.step({{"op", "make"}, {"shape", "points"}});
  client.step({{"op", "compress"}, {"item", 1}, {"tolerance", 0.5}});
  for (const auto& [item, format, kind] :
       std::vector<std::tuple<int, std::string, std::string>>{{1, "ply", "mesh"},
                                                              {1, "obj", "mesh"},
                                                              {1, "off", "mesh"},
                                                              {1, "stl", "mesh"},
                                                              {1, "h5", "expansion"},
                                                              {1, "json", "expansion"},
                                                              {1, "npy", "expansion"},
                                                              {1, "shtools", "expansion"},
                                                              {1, "icgem", "expansion"},
                                                              {1, "txt", "expansion"},
                                                              {2, "ply", "points"},
                                                              {2, "xyz", "points"},
                                                              {3, "h5", "atlas"},
                                                              {3, "ply", "mesh"}}) {
    const Response saved = client.save(item, format);
    ASSERT_EQ(saved.status, 200) << format << saved.body;
    const Response opened = client.open(saved.download, saved.body);
    ASSERT_EQ(opened.status, 200) << format << opened.body;
    EXPECT_EQ(Json::parse(opened.body).at("items").back().at("kind"), kind) << format;
  }
}

TEST(Recipe, WordsAreReadBackAsTheyAre) {
  EXPECT_EQ(shell_word("a-b_c.ply"), "a-b_c.ply");
  EXPECT_EQ(shell_word("two words"), "'two words'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("-rf"), "./-rf");
  EXPECT_EQ(shell_word("-r f"), "'./-r f'");
  EXPECT_EQ(shell_word("$(reboot)"), "'$(reboot)'");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("=ls"), "'=ls'");  // zsh would expand it
  EXPECT_EQ(shell_text("-1"), "-1");
  EXPECT_EQ(python_text("a\"b\\c"), "\"a\\\"b\\\\c\"");
  // U+202E reverses the order of letters. It is written in two parts, because it would affect this
  // line.
  const std::string turns = std::string("\xe2") + "\x80\xae";
  EXPECT_EQ(python_text("a\nb\xff\xc3\xa9" + turns), "\"a\\u000ab\\xff\xc3\xa9\\u202e\"");
}

TEST(Recipe, NamesAreNotTakenTwice) {
  Recipe recipe;
  EXPECT_EQ(recipe.file("a", ".ply"), "a.ply");
  EXPECT_EQ(recipe.file("a", ".ply"), "a-2.ply");
  EXPECT_EQ(recipe.file("a", ".ply"), "a-3.ply");
  EXPECT_EQ(recipe.variable("Two words"), "two_words");
  EXPECT_EQ(recipe.variable("two words"), "two_words_2");
  EXPECT_EQ(recipe.variable("3d"), "s_3d");
  EXPECT_EQ(recipe.variable("class"), "class_");
  EXPECT_EQ(recipe.variable("rholm"), "rholm_");
}

}  // namespace
}  // namespace rholm::studio
