// Every step, undone and redone.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "studio/client.h"
#include "studio/step.h"

namespace rholm::studio {
namespace {

using test::Client;
using test::code_of;
using test::document_of;
using test::last_item;

constexpr double kPi = std::numbers::pi;

// Checks that the step changes something, undo restores the state, and redo repeats the step.
Json check_undone(Client& client, const Json& step) {
  const Json before = client.state();
  const Json after = client.step(step);
  EXPECT_NE(document_of(before), document_of(after)) << step;
  EXPECT_TRUE(after.at("undo").is_string()) << step;
  EXPECT_TRUE(after.at("redo").is_null()) << step;
  const Json undone = client.step({{"op", "undo"}});
  EXPECT_EQ(document_of(undone), document_of(before)) << step;
  EXPECT_EQ(undone.at("redo"), after.at("undo")) << step;
  const Json again = client.step({{"op", "redo"}});
  EXPECT_EQ(document_of(again), document_of(after)) << step;
  return again;
}

TEST(Steps, ShapesAreMadeRenamedRemoved) {
  Client client;
  for (const char* shape : {"bumpy", "sphere", "ellipsoid", "torus", "box", "points"}) {
    const Json state = check_undone(client, {{"op", "make"}, {"shape", shape}});
    EXPECT_EQ(state.at("items").back().at("kind"),
              shape == std::string("points") ? "points" : "mesh");
  }
  const int item = last_item(client.state());
  Json state = check_undone(client, {{"op", "rename"}, {"item", item}, {"name", "other"}});
  EXPECT_EQ(state.at("items").back().at("name"), "other");
  state = check_undone(client, {{"op", "remove"}, {"item", item}});
  EXPECT_EQ(state.at("items").size(), 5U);
}

TEST(Steps, ExpansionsAreMadeLookedAtAlignedBlended) {
  Client client;
  check_undone(client, {{"op", "make"}, {"shape", "bumpy"}});
  const int a = last_item(client.state());
  Json state = check_undone(client, {{"op", "expand"}, {"item", a}, {"degree", 12}});
  EXPECT_EQ(state.at("items")[0].at("expansion").at("degree"), 12);
  EXPECT_EQ(state.at("items")[0].at("expansion").at("power").size(), 13U);
  state = check_undone(client, {{"op", "look"}, {"item", a}, {"degree", 4}});
  EXPECT_EQ(state.at("items")[0].at("look").at("degree"), 4);
  state = check_undone(client,
                       {{"op", "look"}, {"item", a}, {"degree", 3}, {"gains", {1, 0.5, 2, 0.25}}});
  EXPECT_EQ(state.at("items")[0].at("look").at("gains").size(), 4U);

  client.step({{"op", "make"}, {"shape", "ellipsoid"}});
  const int b = last_item(client.state());
  state = check_undone(client, {{"op", "expand"}, {"item", b}, {"tolerance", 0.05}});
  EXPECT_LE(state.at("items")[1].at("expansion").at("rms_per_degree").back().get<double>(), 0.05);
  state = check_undone(client, {{"op", "align"}, {"a", a}, {"b", b}, {"mirror", true}});
  EXPECT_TRUE(state.at("items")[0].at("placed").is_string());
  EXPECT_TRUE(state.at("items")[1].at("placed").is_null());
  state = check_undone(client, {{"op", "align"}, {"a", b}, {"b", a}});
  const std::string placed = state.at("items")[1].at("placed");
  EXPECT_NE(placed.find("onto bumpy.ply: radii differ by "), std::string::npos) << placed;
  // Half turns about its axes map an ellipsoid to itself.
  EXPECT_NE(placed.find("3 other turns are nearly as good."), std::string::npos) << placed;
  state = check_undone(client, {{"op", "blend"}, {"a", a}, {"b", b}, {"t", 0.5}});
  EXPECT_EQ(state.at("items").back().at("kind"), "expansion");
  EXPECT_EQ(state.at("items").size(), 3U);
}

TEST(Steps, SurfacesAreEdited) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const int a = last_item(client.state());
  Json state = check_undone(client, {{"op", "smooth"},
                                     {"item", a},
                                     {"regions", {"vertex:5,0.4"}},
                                     {"wavelength", 0.4},
                                     {"strength", 0.5},
                                     {"fitting", "mean"}});
  check_undone(client, {{"op", "smooth"},
                        {"item", a},
                        {"points", {5, 9}},
                        {"radius", 0.3},
                        {"wavelength", 0.3},
                        {"repair", true}});
  check_undone(client, {{"op", "transfer"},
                        {"source", a},
                        {"from", {"vertex:5,0.4"}},
                        {"target", a},
                        {"to", {"vertex:500,0.4"}},
                        {"height", 2},
                        {"angle", 30},
                        {"refine", true},
                        {"remove_own", true}});
  state = check_undone(client, {{"op", "simplify"}, {"item", a}, {"faces", 3000}});
  EXPECT_LE(state.at("items")[0].at("faces").get<int>(), 3000);
  check_undone(client, {{"op", "simplify"}, {"item", a}, {"error", 0.01}});
}

TEST(Steps, PointsBecomeSurfacesAndCaps) {
  Client client;
  client.step({{"op", "make"}, {"shape", "points"}});
  const int points = last_item(client.state());
  check_undone(client, {{"op", "orient"}, {"item", points}});
  Json state = check_undone(client, {{"op", "reconstruct"},
                                     {"item", points},
                                     {"holes", "keep"},
                                     {"noise", "none"},
                                     {"simplify", 0.2}});
  EXPECT_EQ(state.at("items").back().at("kind"), "mesh");
  EXPECT_GT(state.at("items").back().at("caps").get<int>(), 0);
  const int surface = last_item(state);
  state = check_undone(client, {{"op", "compress"}, {"item", surface}, {"tolerance", 0.3}});
  EXPECT_EQ(state.at("items").back().at("kind"), "atlas");
  const Json atlas = state.at("items").back().at("atlas");
  EXPECT_GT(atlas.at("bytes").get<int>(), 0);
  EXPECT_GT(atlas.at("error").at("rms").get<double>(), 0);
  EXPECT_GT(atlas.at("error").at("max").get<double>(), atlas.at("error").at("rms").get<double>());
  EXPECT_LT(atlas.at("error").at("rms").get<double>(), 0.3);
  const int caps = last_item(state), highest = atlas.at("degree").get<int>();
  state = check_undone(client, {{"op", "atlas_look"}, {"item", caps}, {"limit", highest - 1}});
  EXPECT_EQ(state.at("items").back().at("look").at("degree"), highest - 1);
}

// A table without a header: row numbers, coordinates, and one more column.
constexpr const char* kTable = "1 0 0 2 7\n2 4 0 2 8\n3 0 5 2 9\n4 1 1 3 6\n";

TEST(Steps, ColumnsOfTablesAreToldAndSaid) {
  Client client;
  ASSERT_EQ(client.open("points.txt", kTable).status, 200);
  const Json read = client.state().at("items")[0];
  std::vector<std::string> taken;
  for (const Json& column : read.at("table").at("columns")) taken.push_back(column.at("taken_for"));
  EXPECT_EQ(taken, (std::vector<std::string>{"-", "x", "y", "z", "scalar_1"}));
  EXPECT_NE(read.at("table").at("note").get<std::string>().find("column 1"), std::string::npos);
  EXPECT_EQ(read.at("center"), Json({2, 2.5, 2.5}));
  const Json state =
      check_undone(client, {{"op", "columns"}, {"item", 1}, {"columns", "-,z,x,y,odd'$(name)"}});
  const Json item = state.at("items")[0];
  EXPECT_EQ(item.at("center"), Json({2.5, 2.5, 2}));
  EXPECT_EQ(item.at("name"), "points.txt");
  EXPECT_EQ(item.at("table").at("columns")[4].at("taken_for"), "odd'$(name)");
  EXPECT_EQ(state.at("recipe").at("shell"),
            "rholm convert points.txt points-columns.ply "
            "--columns='-,z,x,y,odd'\\''$(name)'");
  EXPECT_TRUE(state.at("recipe").at("python").get<std::string>().ends_with(
      "\npoints_columns = rholm.read_shape(\"points.txt\", "
      "columns=\"-,z,x,y,odd'$(name)\").shape"));
  // Columns always refer to the table as it was first read.
  const Json again = client.step({{"op", "columns"}, {"item", 1}, {"columns", "x,y,z,-,-"}});
  EXPECT_TRUE(again.at("recipe").at("shell").get<std::string>().ends_with(
      "\nrholm convert points.txt points-columns-2.ply --columns=x,y,z,-,-"));
}

TEST(Steps, ColumnsAreSaidWhereATableIsOpened) {
  Client client;
  EXPECT_EQ(code_of(client.open("points.csv", "a,b,c\n1,2,3\n2,4,3\n")), "unsupported");
  const Response opened = client.ask("POST", "api/file", "a,b,c\n1,2,3\n2,4,3\n",
                                     {{"name", "points.csv"}, {"columns", "x,y,z"}});
  ASSERT_EQ(opened.status, 200) << opened.body;
  const Json state = Json::parse(opened.body);
  EXPECT_EQ(state.at("items")[0].at("center"), Json({1.5, 3, 3}));
  EXPECT_EQ(state.at("items")[0].at("table").at("columns")[0].at("name"), "a");
  EXPECT_EQ(state.at("recipe").at("shell"),
            "rholm convert points.csv points-columns.ply --columns=x,y,z");
  EXPECT_TRUE(state.at("undo").is_null());
  // Points from a session file are no longer a table.
  Client other;
  ASSERT_EQ(other.open("a.rholm", client.ask("GET", "api/session-file").body).status, 200);
  EXPECT_TRUE(other.state().at("items")[0].at("table").is_null());
  EXPECT_EQ(other.state().at("recipe"), state.at("recipe"));
}

TEST(Steps, ColumnsThatCannotBeAreRefused) {
  Client client;
  client.open("points.txt", kTable);
  client.step({{"op", "make"}, {"shape", "box"}});
  client.step({{"op", "make"}, {"shape", "points"}});
  const Json before = client.state();
  const auto said = [&](int item, const std::string& columns) {
    return client.post({{"op", "columns"}, {"item", item}, {"columns", columns}});
  };
  for (const char* columns : {"x,y,z", "x,y,z,-,-,-", "x,y,-,-,-", "x,x,y,z,-", "x,y,z,-,"}) {
    EXPECT_EQ(code_of(said(1, columns)), "invalid_input") << columns;
  }
  EXPECT_EQ(code_of(said(1, "")), "bad_request");
  EXPECT_EQ(code_of(said(2, "x,y,z")), "wrong_kind");
  EXPECT_EQ(code_of(said(3, "x,y,z")), "wrong_kind");
  EXPECT_EQ(client.state(), before);
  for (const char* bytes : {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "\x89HDF\r\n\x1a\n"}) {
    EXPECT_EQ(client.ask("POST", "api/file", bytes, {{"name", "a"}, {"columns", "x,y,z"}}).status,
              422);
  }
}

TEST(Steps, WhatAReaderPassesOverIsTold) {
  Client client;
  client.open("points.txt", "0 0 0\n1 0 nan\n0 1 0\n0 0 1\n");
  const Json warnings = client.state().at("items")[0].at("warnings");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].get<std::string>().find("1 point"), std::string::npos) << warnings;
}

TEST(Steps, DamagedMeshesAreMended) {
  Client client;
  // The mesh is an octahedron without one face.
  const std::string open =
      "OFF\n6 7 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n"
      "3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n";
  ASSERT_EQ(client.open("open.off", open).status, 200);
  EXPECT_FALSE(client.state().at("items")[0].at("closed").get<bool>());
  EXPECT_TRUE(client.state().at("items")[0].at("star").is_null());
  const Json state = check_undone(client, {{"op", "repair"}, {"item", 1}});
  EXPECT_TRUE(state.at("items")[0].at("closed").get<bool>());
  EXPECT_TRUE(state.at("items")[0].at("star").at("star_shaped").get<bool>());
}

TEST(Steps, TheWholeHistoryIsThere) {
  Client client;
  std::vector<Json> states = {document_of(client.state())};
  for (int i = 0; i < 5; ++i) {
    states.push_back(document_of(client.step({{"op", "make"}, {"shape", "box"}})));
  }
  for (int i = 4; i >= 0; --i) EXPECT_EQ(document_of(client.step({{"op", "undo"}})), states[i]);
  EXPECT_EQ(client.post({{"op", "undo"}}).status, 422);
  for (int i = 1; i <= 5; ++i) EXPECT_EQ(document_of(client.step({{"op", "redo"}})), states[i]);
  EXPECT_EQ(client.post({{"op", "redo"}}).status, 422);
  // A step after an undo clears the steps that could be redone.
  client.step({{"op", "undo"}});
  client.step({{"op", "make"}, {"shape", "sphere"}});
  EXPECT_EQ(client.post({{"op", "redo"}}).status, 422);
}

// Returns the value of a row of facts by its label.
std::string fact(const Json& item, const std::string& label) {
  for (const Json& row : item.at("facts")) {
    if (row.at("label") == label) return row.at("value");
  }
  return "";
}

TEST(Steps, FiguresAreOfWhatIsShown) {
  Client client;
  // An ellipsoid of radii 3, 2, 1 becomes at degree 0 a sphere, whose radius is the mean radius.
  client.step({{"op", "make"}, {"shape", "ellipsoid"}});
  Json item = client.step({{"op", "expand"}, {"item", 1}, {"degree", 12}}).at("items")[0];
  EXPECT_EQ(fact(item, "Degree"), "12");
  EXPECT_EQ(fact(item, "Coefficients"), "169");
  const Json rms = item.at("expansion").at("rms_per_degree");
  const double mean = std::sqrt(item.at("expansion").at("power")[0].get<double>() / (4 * kPi));
  item = client.step({{"op", "look"}, {"item", 1}, {"degree", 0}}).at("items")[0];
  EXPECT_EQ(fact(item, "Degree"), "0 of 12");
  EXPECT_EQ(fact(item, "Coefficients"), "1 of 169");
  EXPECT_NEAR(std::stod(fact(item, "Error, rms")), rms[0].get<double>(), 1e-4);
  // The vertices of the shape are moved to that sphere; five digits are shown.
  const Json center = item.at("expansion").at("center");
  Mesh sphere = ellipsoid({3, 2, 1}, 5);
  for (Vec3& v : sphere.vertices) {
    v = v - Vec3{center[0].get<double>(), center[1].get<double>(), center[2].get<double>()};
    v = (mean / norm(v)) * v;
  }
  EXPECT_NEAR(std::stod(fact(item, "Volume")), enclosed_volume(sphere), 1e-3);
  EXPECT_NEAR(std::stod(fact(item, "Diagonal")), std::sqrt(12.0) * mean, 0.01);
  item =
      client.step({{"op", "look"}, {"item", 1}, {"degree", 1}, {"gains", {1, 0.5}}}).at("items")[0];
  EXPECT_EQ(fact(item, "Degree"), "1 of 12, filtered");
  EXPECT_EQ(fact(item, "Error, rms"), "not known");
}

// The error of the whole model is the same wherever it is stated.
TEST(Steps, TheErrorOfAllDegreesIsOne) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  for (const int degree : {4, 40}) {
    const Json item =
        client.step({{"op", "expand"}, {"item", 1}, {"degree", degree}}).at("items")[0];
    const Json row = item.at("expansion").at("error").back();
    EXPECT_EQ(row[0], degree);
    const std::string told = fact(item, "Error, rms");
    if (row[1].is_null()) {
      EXPECT_EQ(told, "not known");
    } else {
      EXPECT_NEAR(std::stod(told), row[1].get<double>(), 1e-4 * row[1].get<double>());
    }
    const Json by_norm = item.at("expansion").at("rms_per_degree").back();
    if (!by_norm.is_null()) {
      EXPECT_EQ(by_norm, row[1]);
    }
  }
}

TEST(Steps, LengthsHaveTheUnitThatIsSet) {
  Client client;
  client.step({{"op", "make"}, {"shape", "ellipsoid"}});
  Json state = check_undone(client, {{"op", "unit"}, {"item", 1}, {"unit", "mm"}});
  EXPECT_EQ(state.at("items")[0].at("unit"), "mm");
  EXPECT_TRUE(fact(state.at("items")[0], "Diagonal").ends_with(" mm"));
  EXPECT_TRUE(fact(state.at("items")[0], "Volume").ends_with(" mm\u00b3"));
  state = client.step({{"op", "expand"}, {"item", 1}, {"degree", 2}});
  EXPECT_NE(state.at("recipe").at("shell").get<std::string>().find("--length-unit mm"),
            std::string::npos);
  EXPECT_TRUE(
      state.at("recipe").at("python").get<std::string>().ends_with(", length_unit=\"mm\")"));
  // The unit is part of the file of a model, so that the recipe also writes another file.
  state = check_undone(client, {{"op", "unit"}, {"item", 1}, {"unit", "km"}});
  EXPECT_TRUE(fact(state.at("items")[0], "Error, rms").ends_with(" km"));
  const std::string python = state.at("recipe").at("python");
  EXPECT_TRUE(python.ends_with(".with_unit(\"km\")")) << python;
  EXPECT_NE(client.save(1, "json").body.find("\"km\""), std::string::npos);
  state = check_undone(client, {{"op", "unit"}, {"item", 1}, {"unit", ""}});
  EXPECT_EQ(fact(state.at("items")[0], "Error, rms").find("km"), std::string::npos);
  EXPECT_EQ(client.post({{"op", "unit"}, {"item", 1}, {"unit", "m\n"}}).status, 422);
}

TEST(Steps, WhatIsOpenedIsNoStep) {
  Client client;
  const std::string box =
      "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  ASSERT_EQ(client.open("first.off", box).status, 200);
  EXPECT_TRUE(client.state().at("undo").is_null());
  EXPECT_EQ(code_of(client.post({{"op", "undo"}})), "nothing");
  client.step({{"op", "expand"}, {"item", 1}, {"degree", 2}});
  client.step({{"op", "remove"}, {"item", 1}});
  client.step({{"op", "undo"}});
  // A file opened between steps stays, whichever of these steps are undone or redone.
  ASSERT_EQ(client.open("second.off", box).status, 200);
  Json state = client.step({{"op", "undo"}});
  ASSERT_EQ(state.at("items").size(), 2U);
  EXPECT_TRUE(state.at("items")[0].at("expansion").is_null());
  EXPECT_EQ(state.at("items")[1].at("name"), "second.off");
  EXPECT_TRUE(state.at("undo").is_null());
  client.step({{"op", "redo"}});
  state = client.step({{"op", "redo"}});
  ASSERT_EQ(state.at("items").size(), 1U);
  EXPECT_EQ(state.at("items")[0].at("name"), "second.off");
  EXPECT_EQ(state.at("recipe").at("python").get<std::string>(),
            "import rholm\nfirst = rholm.read_shape(\"first.off\").shape\n"
            "first_model = rholm.expand(first, degree=2)\n"
            "second = rholm.read_shape(\"second.off\").shape");
}

TEST(Steps, WhatAPageBeginsWithIsNotUndone) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}, {"first", true}});
  Json state = client.step({{"op", "expand"}, {"item", 1}, {"degree", 4}, {"first", true}});
  EXPECT_TRUE(state.at("undo").is_null());
  EXPECT_EQ(state.at("items")[0].at("expansion").at("degree"), 4);
  client.step({{"op", "look"}, {"item", 1}, {"degree", 2}});
  client.step({{"op", "make"}, {"shape", "box"}, {"first", true}});  // an item before it exists
  client.step({{"op", "undo"}});
  state = client.step({{"op", "undo"}});
  EXPECT_TRUE(state.at("undo").is_null());
  EXPECT_EQ(state.at("items").size(), 1U);
}

TEST(Steps, WhatDocumentsShareCountsOnce) {
  Document one;
  Item item;
  Mesh mesh;
  mesh.vertices.resize(1000);
  item.original = std::make_shared<const Mesh>(mesh);
  item.shown = item.original;
  one.items.push_back(std::make_shared<const Item>(item));
  Document two = one;
  const std::vector<const Document*> both = {&one, &two};
  EXPECT_EQ(bytes_of(both), 1000 * sizeof(Vec3));
  item.shown = std::make_shared<const Mesh>(mesh);
  two.items.push_back(std::make_shared<const Item>(item));
  EXPECT_EQ(bytes_of(both), 2000 * sizeof(Vec3));
  EXPECT_EQ(bytes_of(std::span(both).first(1)), 1000 * sizeof(Vec3));
}

TEST(Steps, AHundredStepsAreKept) {
  Client client;
  client.step({{"op", "make"}, {"shape", "box"}});
  for (int i = 0; i < 105; ++i) {
    client.step({{"op", "rename"}, {"item", 1}, {"name", std::to_string(i)}});
  }
  int undone = 0;
  while (client.post({{"op", "undo"}}).status == 200) ++undone;
  EXPECT_EQ(undone, 100);
}

TEST(Steps, RevisionsAndNumbersNeverComeAgain) {
  Client client;
  std::set<int> items;
  std::set<std::uint64_t> revisions;
  for (int i = 0; i < 3; ++i) {
    const Json item = client.step({{"op", "make"}, {"shape", "box"}}).at("items").back();
    EXPECT_TRUE(items.insert(item.at("id").get<int>()).second);
    EXPECT_TRUE(revisions.insert(item.at("revision").get<std::uint64_t>()).second);
    client.step({{"op", "undo"}});
  }
}

TEST(Steps, TheDegreeOfAToleranceIsTheSmallest) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const Json state = client.step({{"op", "expand"}, {"item", 1}, {"degree", 20}});
  const Json rms = state.at("items")[0].at("expansion").at("rms_per_degree");
  const Json found =
      Json::parse(client.post({{"op", "degree_for"}, {"item", 1}, {"tolerance", 0.01}}).body);
  const int degree = found.at("degree");
  EXPECT_TRUE(found.at("met").get<bool>());
  EXPECT_LE(rms[degree].get<double>(), 0.01);
  EXPECT_GT(rms[degree - 1].get<double>(), 0.01);
  const Json none =
      Json::parse(client.post({{"op", "degree_for"}, {"item", 1}, {"tolerance", 1e-9}}).body);
  EXPECT_FALSE(none.at("met").get<bool>());
  EXPECT_EQ(client.state().at("undo"), state.at("undo"));  // adds no step
}

// A shown state may be saved: the recipe has its line until the whole model is shown again.
TEST(Recipe, HasWhatIsOnlyShown) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const auto recipe_of = [](const Json& state) {
    return state.at("recipe").at("shell").get<std::string>();
  };
  const std::string whole = recipe_of(client.step({{"op", "expand"}, {"item", 1}, {"degree", 8}}));
  const std::string cut = recipe_of(client.step({{"op", "look"}, {"item", 1}, {"degree", 3}}));
  EXPECT_EQ(cut, whole +
                     "\nrholm synthesize bumpy.h5 --degree 3 --like bumpy.ply -o "
                     "bumpy-surface.ply");
  EXPECT_EQ(recipe_of(client.step({{"op", "look"}, {"item", 1}, {"degree", 2}})),
            whole + "\nrholm synthesize bumpy.h5 --degree 2 --like bumpy.ply -o bumpy-surface.ply");
  EXPECT_EQ(recipe_of(client.step({{"op", "look"}, {"item", 1}, {"degree", 8}})), whole);
}

}  // namespace
}  // namespace rholm::studio
