// Options of steps, as the page is told of them, in requests and in recipes.
#include <set>

#include "client.h"
#include "rholm/reconstruct.h"
#include "studio/controls.h"

namespace rholm::studio {
namespace {

using test::Client;

Json controls_of(Client& client, const char* op) {
  return Json::parse(client.ask("GET", "api/controls").body).at(op);
}

const Json* named(const Json& controls, const std::string& name) {
  for (const Json& one : controls) {
    if (one.at("name") == name) return &one;
  }
  return nullptr;
}

TEST(Controls, HaveEveryFieldOfTheListThatIsAskedFor) {
  Client client;
  const Json controls = controls_of(client, "reconstruct");
  const ReconstructOptions standard;
  std::set<std::string> asked;
  for_each_field<ReconstructOptions>([&](auto member, const FieldInfo& info) {
    using V = std::remove_cvref_t<decltype(standard.*member)>;
    if (!is_asked<V>(info)) return;
    asked.insert(info.name);
    const Json* control = named(controls, info.name);
    ASSERT_NE(control, nullptr) << info.name;
    EXPECT_EQ(control->at("help"), info.help);
    if constexpr (NamedEnum<V>) {
      EXPECT_EQ(control->at("default"), to_string(standard.*member));
      EXPECT_EQ(control->at("choices").size(), names_of(standard.*member).names.size());
    } else if constexpr (std::is_arithmetic_v<V>) {
      EXPECT_EQ(control->at("default"), Json(standard.*member));
      if constexpr (!std::is_same_v<V, bool>) {
        EXPECT_EQ(control->at("least"), Json(info.least));
      }
    }
  });
  const std::set<std::string> wanted = {"holes",         "blend",      "min_component",
                                        "keep_outliers", "keep_scans", "confidence",
                                        "tile_points"};
  EXPECT_EQ(asked, wanted);
}

TEST(Controls, RangesAndLabelsArePutUponTheList) {
  Client client;
  const Json holes = *named(controls_of(client, "reconstruct"), "holes");
  EXPECT_EQ(holes.at("choices").at(0), Json({{"value", "fill"}, {"label", "Close all"}}));
  EXPECT_TRUE(holes.at("shown").get<bool>());
  const Json height = *named(controls_of(client, "transfer"), "height");
  EXPECT_EQ(height.at("least"), -2);
  EXPECT_EQ(height.at("most"), 4);
  EXPECT_EQ(height.at("default"), 1.0);
  EXPECT_FALSE(named(controls_of(client, "transfer"), "from_degree")->at("shown").get<bool>());
}

TEST(Controls, OptionsOfTheListGoToTheLibraryAndIntoTheRecipe) {
  Client client;
  client.step({{"op", "make"}, {"shape", "points"}});
  client.step({{"op", "reconstruct"},
               {"item", 1},
               {"blend", "spline"},
               {"min_component", 0.5},
               {"keep_outliers", true},
               {"confidence", false},
               {"tile_points", nullptr}});
  const Json recipe = client.state().at("recipe");
  EXPECT_NE(
      recipe.at("shell").get<std::string>().find(
          "rholm reconstruct points.ply --blend spline --min-component 0.5 --keep-outliers -o"),
      std::string::npos)
      << recipe;
  EXPECT_NE(recipe.at("python").get<std::string>().find(
                "rholm.reconstruct(points, blend=\"spline\", min_component=0.5, "
                "keep_outliers=True).mesh"),
            std::string::npos)
      << recipe;
}

TEST(Controls, ValuesOutOfTheBoundsOfTheListAreRefused) {
  Client client;
  client.step({{"op", "make"}, {"shape", "points"}});
  const std::vector<std::pair<const char*, Json>> wrong = {
      {"min_component", 2},  {"min_component", "x"}, {"blend", "hard"},
      {"keep_scans", "yes"}, {"tile_points", 999},   {"tile_points", 1000.5}};
  for (const auto& [name, value] : wrong) {
    const Response answer = client.post({{"op", "reconstruct"}, {"item", 1}, {name, value}});
    EXPECT_EQ(answer.status, 400) << name << value << answer.body;
    EXPECT_NE(answer.body.find(name), std::string::npos) << answer.body;
  }
}

}  // namespace
}  // namespace rholm::studio
