// Every kind of wrong request, and the answer to it.
#include <gtest/gtest.h>

#include "studio/client.h"
#include "studio/names.h"

namespace rholm::studio {
namespace {

using test::Client;
using test::code_of;

TEST(Errors, PathsThatAreNone) {
  Client client;
  for (const auto& [method, path] :
       std::vector<std::pair<std::string, std::string>>{{"GET", ""},
                                                        {"GET", "api"},
                                                        {"GET", "api/"},
                                                        {"PUT", "api/state"},
                                                        {"POST", "api/state"},
                                                        {"GET", "api/step"},
                                                        {"GET", "api/item/1"},
                                                        {"GET", "api/item//surface"},
                                                        {"GET", "api/item/x/surface"},
                                                        {"GET", "api/item/1/surface"},
                                                        {"GET", "api/item/99999999999999/surface"},
                                                        {"GET", "api/save"},
                                                        {"POST", "api/job/1/cancel"},
                                                        {"POST", "api/job//cancel"},
                                                        {"POST", "api/job/cancel"},
                                                        {"GET", "../../etc/passwd"}}) {
    const Response answer = client.ask(method, path);
    EXPECT_EQ(answer.status, 404) << method << ' ' << path;
    EXPECT_EQ(code_of(answer), "not_found") << method << ' ' << path;
  }
}

TEST(Errors, SessionsThatAreNone) {
  Client client;
  for (const char* id : {"", "x", "0123456789abcdef"}) {
    for (const char* path : {"api/state", "api/session-file"}) {
      const Response answer = client.studio.handle({.path = path, .session = id});
      EXPECT_EQ(answer.status, 404);
      EXPECT_EQ(code_of(answer), "no_session");
    }
  }
  // Clients that cannot send a header put the session into the query.
  EXPECT_EQ(client.studio.handle({.path = "api/state", .query = {{"session", client.id}}}).status,
            200);
  EXPECT_EQ(client.ask("DELETE", "api/session").status, 200);
  EXPECT_EQ(client.ask("GET", "api/state").status, 404);
  EXPECT_EQ(client.ask("DELETE", "api/session").status, 404);
}

TEST(Errors, MoreSessionsThanAllowed) {
  Client client({.threads = 1, .max_sessions = 2});
  EXPECT_EQ(client.ask("POST", "api/session").status, 200);
  EXPECT_EQ(client.ask("POST", "api/session").status, 503);
  EXPECT_EQ(client.ask("POST", "api/session/close").status, 200);
  EXPECT_EQ(client.ask("POST", "api/session").status, 200);
}

TEST(Errors, BodiesThatAreNoRequests) {
  Client client;
  for (const char* path : {"api/step", "api/live"}) {
    for (const std::string& body :
         {std::string(), std::string("nothing"), std::string("[]"), std::string("3"),
          std::string("{\"op\":"), std::string("{}"), std::string("{\"op\":3,\"live\":3}"),
          std::string("{\"op\":\"fly\",\"live\":\"fly\"}"), std::string("{\"op\":\"\xff\"}"),
          std::string(100000, '['), std::string("\0{}", 3)}) {
      const Response answer = client.ask("POST", path, body);
      EXPECT_EQ(answer.status, 400) << path << ' ' << body.substr(0, 30);
      EXPECT_EQ(code_of(answer), "bad_request") << path << ' ' << body.substr(0, 30);
    }
  }
}

TEST(Errors, FieldsThatAreMissingOrWrong) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "analyze"}, {"item", 1}, {"degree", 4}});
  client.step({{"op", "make"}, {"shape", "points"}});
  const Json before = client.state();
  const std::vector<Json> wrong = {
      {{"op", "make"}, {"shape", "pear"}},
      {{"op", "make"}, {"shape", 3}},
      {{"op", "make"}, {"shape", "bumpy"}, {"amplitude", 1}},
      {{"op", "make"}, {"shape", "bumpy"}, {"amplitude", -0.1}},
      {{"op", "make"}, {"shape", "bumpy"}, {"seed", -1}},
      {{"op", "rename"}, {"item", 1}},
      {{"op", "rename"}, {"item", 1}, {"name", ""}},
      {{"op", "rename"}, {"item", 1}, {"name", std::string(300, 'x')}},
      {{"op", "remove"}},
      {{"op", "remove"}, {"item", "1"}},
      {{"op", "remove"}, {"item", 1.5}},
      {{"op", "remove"}, {"item", 1e300}},
      {{"op", "analyze"}, {"item", 1}},
      {{"op", "analyze"}, {"item", 1}, {"degree", -1}},
      {{"op", "analyze"}, {"item", 1}, {"degree", 100000}},
      {{"op", "look"}, {"item", 1}, {"degree", 5}},
      {{"op", "look"}, {"item", 1}, {"degree", -1}},
      {{"op", "look"}, {"item", 1}, {"degree", 1}, {"gains", {1, 1, 1}}},
      {{"op", "look"}, {"item", 1}, {"degree", 1}, {"gains", {1, "x"}}},
      {{"op", "look"}, {"item", 1}, {"degree", 1}, {"gains", 3}},
      {{"op", "smooth"}, {"item", 1}, {"wavelength", 1}},
      {{"op", "smooth"}, {"item", 1}, {"wavelength", 1}, {"regions", Json::array()}},
      {{"op", "smooth"}, {"item", 1}, {"wavelength", 1}, {"points", Json::array()}, {"radius", 1}},
      {{"op", "smooth"}, {"item", 1}, {"regions", {"vertex:1,1"}}},
      {{"op", "smooth"},
       {"item", 1},
       {"regions", {"vertex:1,1"}},
       {"wavelength", 1},
       {"fitting", "nicely"}},
      {{"op", "smooth"},
       {"item", 1},
       {"regions", {"vertex:1,1"}},
       {"wavelength", 1},
       {"fitting", "mean"},
       {"repair", true}},
      {{"op", "smooth"},
       {"item", 1},
       {"regions", {"vertex:1,1"}},
       {"wavelength", 1},
       {"repair", "yes"}},
      {{"op", "transfer"}, {"source", 1}, {"target", 1}, {"from", {"vertex:1,1"}}},
      {{"op", "simplify"}, {"item", 1}},
      {{"op", "simplify"}, {"item", 1}, {"faces", 0}},
      {{"op", "simplify"}, {"item", 1}, {"error", -1}},
      {{"op", "reconstruct"}, {"item", 2}, {"holes", "maybe"}},
      {{"op", "reconstruct"}, {"item", 2}, {"noise", "loud"}},
      {{"op", "reconstruct"}, {"item", 2}, {"simplify", 2}},
      {{"op", "compress"}, {"item", 1}},
      {{"op", "align"}, {"a", 1}, {"b", 1}},
      {{"op", "blend"}, {"a", 1}, {"b", 1}}};
  for (const Json& step : wrong) {
    const Response answer = client.post(step);
    EXPECT_EQ(answer.status, 400) << step << answer.body;
    EXPECT_EQ(code_of(answer), "bad_request") << step;
  }
  EXPECT_EQ(client.state(), before);
}

TEST(Errors, ItemsThatAreNotThereOrOfAnotherKind) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "make"}, {"shape", "points"}});
  for (const char* op : {"remove", "analyze", "look", "smooth", "simplify", "orient", "compress"}) {
    EXPECT_EQ(client.post({{"op", op}, {"item", 77}}).status, 404) << op;
  }
  for (const Json& step : std::vector<Json>{{{"op", "look"}, {"item", 1}, {"degree", 1}},
                                            {{"op", "degree_for"}, {"item", 1}, {"tolerance", 1}},
                                            {{"op", "analyze"}, {"item", 2}, {"degree", 1}},
                                            {{"op", "smooth"}, {"item", 2}},
                                            {{"op", "orient"}, {"item", 1}},
                                            {{"op", "reconstruct"}, {"item", 1}},
                                            {{"op", "atlas_look"}, {"item", 1}, {"limit", 1}},
                                            {{"op", "align"}, {"a", 1}, {"b", 2}}}) {
    const Response answer = client.post(step);
    EXPECT_EQ(answer.status, 422) << step << answer.body;
    EXPECT_EQ(code_of(answer), "wrong_kind") << step;
  }
  EXPECT_EQ(client.live({{"live", "degree"}, {"item", 1}, {"degree", 0}}).status, 422);
  EXPECT_EQ(client.ask("GET", "api/item/1/measures").status, 422);
}

TEST(Errors, CapsAreAdvisedForWhatIsNotStarShapedUnlessItIsCaps) {
  Client client;
  client.step({{"op", "make"}, {"shape", "torus"}});
  client.step({{"op", "compress"}, {"item", 1}, {"tolerance", 0.2}});
  const Json items = client.state().at("items");
  const auto advised = [](const Json& item) {
    const Json& star = item.at("star");
    EXPECT_FALSE(star.at("star_shaped").get<bool>());
    return star.at("why").get<std::string>().find("Caps take") != std::string::npos;
  };
  EXPECT_TRUE(advised(items.at(0)));
  EXPECT_FALSE(advised(items.at(1)));
}

TEST(Errors, WhatTheLibraryRefusesIsSaidInItsWords) {
  Client client;
  client.step({{"op", "make"}, {"shape", "torus"}});
  const Json refused = client.step({{"op", "analyze"}, {"item", 1}, {"degree", 8}}).at("job");
  EXPECT_EQ(refused.at("state"), "failed");
  EXPECT_NE(refused.at("message").get<std::string>().find("star-shaped"), std::string::npos);
  const Json star = client.state().at("items")[0].at("star");
  EXPECT_FALSE(star.at("star_shaped").get<bool>());
  EXPECT_GT(star.at("offending").get<int>(), 0);
  const auto arrays = test::arrays_of(client.ask("GET", "api/item/1/surface").body);
  EXPECT_EQ(arrays.at("offending").shape[0], star.at("offending").get<std::size_t>());
  // A live request is answered at once, with the name of the error itself.
  const Response live = client.live(
      {{"live", "smooth"}, {"item", 1}, {"wavelength", 0.3}, {"regions", {"vertex:999999,0.4"}}});
  EXPECT_EQ(live.status, 422);
  EXPECT_EQ(code_of(live), "invalid_input");
}

TEST(Errors, FilesThatAreNone) {
  Client client({.threads = 1, .max_upload = 1000});
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.ply", ""},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n"},
      {"a.obj", "f 1 2 3\n"},
      {"a.h5", "\x89HDF\r\n\x1a\n"},
      {"a.h5", "\x89HDF\r\n\x1a\nmore that is no such file"},
      {"a.json", "{\"format\":\"rholm-coefficients\"}"},
      {"a.sh", "0 0 nothing"},
      {"a", std::string(900, '\xff')},
      {"a.rholm", "RHOLMSS1"}};
  for (const auto& [name, bytes] : files) {
    const Response answer = client.open(name, bytes);
    EXPECT_EQ(answer.status, 422) << name << ' ' << answer.body;
    EXPECT_NE(code_of(answer), "") << name;
  }
  EXPECT_EQ(client.open("a.ply", std::string(1001, 'x')).status, 413);
  EXPECT_TRUE(client.state().at("items").empty());
  EXPECT_TRUE(client.state().at("undo").is_null());
}

TEST(Errors, NamesAreNames) {
  EXPECT_EQ(plain_name("a.ply"), "a.ply");
  EXPECT_EQ(plain_name("../../etc/passwd"), "passwd");
  EXPECT_EQ(plain_name("C:\\shapes\\a.ply"), "a.ply");
  EXPECT_EQ(plain_name("a\nb\x7f.ply"), "ab.ply");
  EXPECT_EQ(plain_name(".."), "shape");
  EXPECT_EQ(plain_name("folder/"), "shape");
  EXPECT_EQ(plain_name(std::string(1000, 'x')).size(), 200U);
  // A name that is invalid UTF-8 does not break the state.
  Client client;
  EXPECT_EQ(client.open("\xff\xfe.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").status, 200);
  EXPECT_EQ(client.state().at("items").size(), 1U);
}

}  // namespace
}  // namespace rholm::studio
