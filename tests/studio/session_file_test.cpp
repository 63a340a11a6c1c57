// A session as a file: all that is seen comes back; what is not whole is refused.
#include <cstring>

#include <gtest/gtest.h>

#include "base/crc32.h"
#include "studio/client.h"
#include "studio/session_file.h"

namespace rholm::studio {
namespace {

using test::Client;
using test::code_of;

// What is seen of items, without numbers that are of a session.
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
  client.step({{"op", "analyze"}, {"item", 1}, {"degree", 2}});
  client.step({{"op", "look"}, {"item", 1}, {"degree", 1}, {"gains", {1, 0.5}}});
  return client.ask("GET", "api/session-file").body;
}

// The same with another description of its items, and the right checksum.
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
  client.step({{"op", "analyze"}, {"item", 1}, {"degree", 10}});
  client.step({{"op", "look"}, {"item", 1}, {"degree", 4}});
  client.step({{"op", "make"}, {"shape", "points"}});
  client.step({{"op", "compress"}, {"item", 1}, {"tolerance", 0.05}});
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
    if (i >= 20 && i < 24) continue;  // bytes that say nothing
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
  Json json = right;
  json["shell"] = 3;
  wrong.push_back(json);
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

}  // namespace
}  // namespace rholm::studio
