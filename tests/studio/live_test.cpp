// Live requests, compared with the full computations of the library.
#include <cmath>
#include <future>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rholm/filter.h"
#include "rholm/model.h"
#include "rholm/primitives.h"
#include "rholm/smooth.h"
#include "rholm/synthesize.h"
#include "rholm/topology.h"
#include "rholm/transfer.h"
#include "studio/client.h"
#include "studio/items/binary.h"

namespace rholm::studio {
namespace {

using test::Array;
using test::arrays_of;
using test::Client;
using test::code_of;

// The surface of `make bumpy`, and the expansion that analyze makes of it.
Mesh bumpy() { return bumpy_sphere(5); }
Expansion expansion_of_bumpy(int degree) {
  ExpandOptions options;
  options.degree = degree;
  return expand(bumpy(), options).transform.expansion;
}

void expect_near(const Array& array, std::span<const Vec3> wanted, double error) {
  ASSERT_EQ(array.type, "f32");
  ASSERT_EQ(array.shape, (std::vector<std::size_t>{wanted.size(), 3}));
  const std::vector<float> values = array.as<float>();
  double worst = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    worst = std::max(worst,
                     norm(Vec3{values[3 * i], values[3 * i + 1], values[3 * i + 2]} - wanted[i]));
  }
  EXPECT_LT(worst, error);
}

struct Analyzed : Client {
  explicit Analyzed(int degree) {
    step({{"op", "make"}, {"shape", "bumpy"}});
    step({{"op", "expand"}, {"item", 1}, {"degree", degree}});
  }
};

TEST(Live, DegreesAreTheSurfacesOfTheLibrary) {
  Analyzed client(20);
  const Mesh shape = bumpy();
  const Expansion expansion = expansion_of_bumpy(20);
  const Mesh sphere = directions_of(shape, expansion.center);
  for (const int degree : {0, 1, 7, 20}) {
    const Response answer =
        client.live({{"live", "degree"}, {"item", 1}, {"degree", degree}, {"error", true}});
    ASSERT_EQ(answer.status, 200) << answer.body;
    const auto arrays = arrays_of(answer.body);
    const Mesh wanted = synthesize(expansion, sphere, std::span(&degree, 1)).front();
    expect_near(arrays.at("positions"), wanted.vertices, 1e-6);
    std::vector<Vec3> normals = area_normals(wanted.vertices, wanted.faces);
    for (Vec3& n : normals) n = normalized(n);
    expect_near(arrays.at("normals"), normals, 1e-4);
    const std::vector<float> error = arrays.at("error").as<float>();
    for (std::size_t i = 0; i < error.size(); i += 97) {
      const double along =
          norm(wanted.vertices[i] - expansion.center) - norm(shape.vertices[i] - expansion.center);
      EXPECT_NEAR(error[i], along, 1e-6);
    }
  }
}

// A sphere as a file of separate triangles, without common vertices.
TEST(Live, ASeamOfTheFileIsNoCrease) {
  const Mesh sphere = icosphere(3);
  std::vector<Vec3> corners;
  std::string vertices, faces;
  for (const Triangle& t : sphere.faces) {
    const std::size_t n = corners.size();
    faces += fmt::format("3 {} {} {}\n", n, n + 1, n + 2);
    for (const std::uint32_t corner : t) {
      const Vec3& v = corners.emplace_back(sphere.vertices[corner]);
      vertices += fmt::format("{} {} {}\n", v.x, v.y, v.z);
    }
  }
  const std::string head = fmt::format("OFF\n{} {} 0\n", corners.size(), sphere.faces.size());
  Client client;
  client.open("cut.off", head + vertices + faces);
  const Response surface = client.ask("GET", "api/item/1/surface");
  expect_near(arrays_of(surface.body).at("normals"), corners, 0.02);
  client.step({{"op", "expand"}, {"item", 1}, {"degree", 4}});
  const Response look = client.live({{"live", "degree"}, {"item", 1}, {"degree", 4}});
  expect_near(arrays_of(look.body).at("normals"), corners, 0.02);
}

TEST(Live, GainsAreAFilter) {
  Analyzed client(10);
  const std::vector<double> gains = {1, 0.9, 1.4, 0, 0.5};
  const Expansion expansion = expansion_of_bumpy(10);
  const Mesh wanted =
      synthesize(filter(expansion, gains, ""), directions_of(bumpy(), expansion.center));
  const Response answer =
      client.live({{"live", "degree"}, {"item", 1}, {"degree", 4}, {"gains", gains}});
  ASSERT_EQ(answer.status, 200) << answer.body;
  expect_near(arrays_of(answer.body).at("positions"), wanted.vertices, 1e-6);
  EXPECT_EQ(arrays_of(answer.body).count("error"), 0U);
}

TEST(Live, ALookKeepsWhatWasSeen) {
  Analyzed client(16);
  const auto seen = arrays_of(client.live({{"live", "degree"}, {"item", 1}, {"degree", 5}}).body);
  client.step({{"op", "look"}, {"item", 1}, {"degree", 5}});
  const auto kept = arrays_of(client.ask("GET", "api/item/1/surface").body);
  const std::vector<float> a = seen.at("positions").as<float>(),
                           b = kept.at("positions").as<float>();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-6);
  // The original shape is unchanged.
  const auto original =
      arrays_of(client.ask("GET", "api/item/1/surface", {}, {{"original", "1"}}).body);
  expect_near(original.at("positions"), bumpy().vertices, 1e-6);
}

TEST(Live, SmoothingIsThatOfTheLibrary) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const std::vector<Region> region = {DiscRegion{.vertex = 5, .radius = 0.4}};
  Mesh mesh = bumpy();
  const Patch patch = analyze_patch(mesh, region, {.wavelength = 0.3});
  for (const auto& [wavelength, strength] : {std::pair{0.3, 1.0}, {0.35, 0.5}}) {
    const Response answer = client.live({{"live", "smooth"},
                                         {"item", 1},
                                         {"regions", {"vertex:5,0.4"}},
                                         {"wavelength", wavelength},
                                         {"strength", strength}});
    ASSERT_EQ(answer.status, 200) << answer.body;
    const auto arrays = arrays_of(answer.body);
    EXPECT_EQ(arrays.at("indices").as<std::uint32_t>(), patch.vertices);
    expect_near(arrays.at("positions"),
                update(patch, {.wavelength = wavelength, .strength = strength}), 1e-6);
  }
  EXPECT_EQ(client.state().at("undo"), "Make bumpy");  // adds no step
}

TEST(Live, AnAnalysisIsNotUsedForAnotherSurface) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const Json look = {
      {"live", "smooth"}, {"item", 1}, {"regions", {"vertex:5,0.4"}}, {"wavelength", 0.3}};
  const std::string first = client.live(look).body;
  client.step({{"op", "smooth"}, {"item", 1}, {"regions", {"vertex:5,0.4"}}, {"wavelength", 0.3}});
  const auto before = arrays_of(first), after = arrays_of(client.live(look).body);
  EXPECT_NE(before.at("positions").bytes, after.at("positions").bytes);
}

TEST(Live, TransferIsThatOfTheLibrary) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const Mesh mesh = bumpy();
  const std::vector<Region> from = {DiscRegion{5, 0.4}}, to = {DiscRegion{500, 0.4}};
  Json look = {{"live", "transfer"},       {"source", 1}, {"from", {"vertex:5,0.4"}}, {"target", 1},
               {"to", {"vertex:500,0.4"}}, {"height", 3}};
  const TransferAnalysis transform = analyze_transfer(mesh, from, mesh, to);
  auto arrays = arrays_of(client.live(look).body);
  EXPECT_EQ(arrays.at("indices").as<std::uint32_t>(), transform.patch.vertices);
  expect_near(arrays.at("positions"), update(transform, {.height = 3}), 1e-6);
  look["refine"] = true;
  arrays = arrays_of(client.live(look).body);
  const Mesh refined = transfer(mesh, from, mesh, to, {.refine = true}, {.height = 3});
  expect_near(arrays.at("positions"), refined.vertices, 1e-6);
  EXPECT_EQ(arrays.at("triangles").shape[0], refined.faces.size());
  EXPECT_EQ(arrays.count("indices"), 0U);
}

TEST(Live, TheBrushWeighsVerticesNearby) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const std::vector<Region> discs = {DiscRegion{5, 0.2}, DiscRegion{9, 0.2}};
  const std::vector<double> weights = region_weights(bumpy(), discs, 0.1);
  const auto arrays = arrays_of(
      client.live({{"live", "brush"}, {"item", 1}, {"points", {5, 9}}, {"radius", 0.2}}).body);
  const auto indices = arrays.at("indices").as<std::uint32_t>();
  const auto values = arrays.at("weights").as<float>();
  ASSERT_GT(indices.size(), 2U);
  EXPECT_EQ(static_cast<std::ptrdiff_t>(indices.size()),
            std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; }));
  for (std::size_t i = 0; i < indices.size(); ++i)
    EXPECT_NEAR(values[i], weights[indices[i]], 1e-6);
}

TEST(Live, BlendsBeginAndEndAtTheirShapes) {
  Analyzed client(10);
  client.step({{"op", "make"}, {"shape", "ellipsoid"}});
  client.step({{"op", "expand"}, {"item", 2}, {"degree", 14}});
  const Expansion a = expansion_of_bumpy(10);
  const Mesh sphere = directions_of(bumpy(), a.center);
  ExpandOptions options;
  options.degree = 14;
  const Expansion b = expand(ellipsoid({3, 2, 1}, 5), options).transform.expansion;
  for (const auto& [t, end] : {std::pair{0.0, &a}, {1.0, &b}}) {
    const auto arrays =
        arrays_of(client.live({{"live", "blend"}, {"a", 1}, {"b", 2}, {"t", t}}).body);
    expect_near(arrays.at("positions"), synthesize(*end, sphere).vertices, 1e-4);
  }
}

TEST(Live, OfManyAtOnceTheNewestIsAnswered) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  std::vector<std::future<Response>> answers;
  answers.reserve(40);
  for (int i = 0; i < 40; ++i) {
    answers.push_back(std::async(std::launch::async, [&client, i] {
      return client.live({{"live", "smooth"},
                          {"item", 1},
                          {"wavelength", 0.3},
                          {"regions", {"vertex:" + std::to_string(10 * i) + ",0.4"}}});
    }));
  }
  int answered = 0;
  for (auto& one : answers) {
    const Response answer = one.get();
    if (answer.status == 200) {
      ++answered;
    } else {
      EXPECT_EQ(answer.status, 409);
      EXPECT_EQ(code_of(answer), "superseded");
    }
  }
  EXPECT_GE(answered, 1);
}

TEST(Binary, IsAsItSays) {
  for (std::size_t n = 0; n < 40; ++n) {
    Binary binary;
    binary.meta["text"] = std::string(n, 'x');
    const std::vector<float> f = {1.5F, -2};
    const std::vector<std::uint32_t> u = {7};
    const std::vector<std::uint8_t> b(3 * n, 9);
    binary.add("f", f, {1, 2});
    binary.add("u", u, {1});
    binary.add("b", b, {n, 3});
    const auto arrays = arrays_of(binary.bytes());
    EXPECT_EQ(arrays.at("f").as<float>(), f);
    EXPECT_EQ(arrays.at("u").as<std::uint32_t>(), u);
    EXPECT_EQ(arrays.at("b").as<std::uint8_t>(), b);
  }
}

TEST(Windows, AreThoseOfTheLibrary) {
  Client client;
  const Json answer = Json::parse(client.ask("GET", "api/windows").body);
  EXPECT_EQ(answer.at("default"), to_string(WindowOptions{}.window));
  ASSERT_EQ(answer.at("windows").size(), windows().size());
  for (std::size_t i = 0; i < windows().size(); ++i) {
    EXPECT_EQ(answer.at("windows").at(i).at("name"), windows()[i].name);
    EXPECT_EQ(answer.at("windows").at(i).at("parameters").size(), windows()[i].parameters.size());
  }
}

TEST(Windows, GainsAreThoseOfTheLibraryToTheLastBit) {
  Client client;
  const auto gains = [&](const std::map<std::string, std::string>& query) {
    const Response answer = client.ask("GET", "api/gains", {}, query);
    EXPECT_EQ(answer.status, 200) << answer.body;
    return Json::parse(answer.body).at("gains").get<std::vector<double>>();
  };
  for (const WindowInfo& info : windows()) {
    EXPECT_EQ(gains({{"window", info.name}, {"cutoff", "13"}, {"degree", "40"}}),
              low_pass(13, 40, {.window = info.window}))
        << info.name;
  }
  EXPECT_EQ(gains({{"window", "heat"}, {"cutoff", "0"}, {"degree", "9"}, {"time", "0.01"}}),
            low_pass(0, 9, {.window = Window::kHeat, .time = 0.01}));
  EXPECT_EQ(gains({{"window", "exponential"}, {"cutoff", "7"}, {"degree", "9"}, {"order", "2"}}),
            low_pass(7, 9, {.window = Window::kExponential, .order = 2}));
}

TEST(Windows, GainsThatCannotBeAreRefused) {
  Client client;
  const auto refusal = [&](const std::map<std::string, std::string>& query) {
    return code_of(client.ask("GET", "api/gains", {}, query));
  };
  EXPECT_EQ(refusal({}), "bad_request");
  EXPECT_EQ(refusal({{"window", "ideal"}, {"cutoff", "x"}, {"degree", "4"}}), "bad_request");
  EXPECT_EQ(refusal({{"window", "round"}, {"cutoff", "4"}, {"degree", "4"}}), "invalid_input");
  EXPECT_EQ(refusal({{"window", "ideal"}, {"cutoff", "4"}, {"degree", "-1"}}), "invalid_input");
  EXPECT_EQ(refusal({{"window", "heat"}, {"cutoff", "4"}, {"degree", "4"}, {"time", "0"}}),
            "invalid_input");
  EXPECT_EQ(
      refusal({{"window", "exponential"}, {"cutoff", "4"}, {"degree", "4"}, {"order", "2.5"}}),
      "invalid_input");
}

}  // namespace
}  // namespace rholm::studio
