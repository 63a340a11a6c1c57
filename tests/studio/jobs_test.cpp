// Jobs on a thread: how they end, what remains after them, and who is told.
#include <malloc.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "io/file/leftovers.h"
#include "studio/client.h"

namespace rholm::studio {
namespace {

using namespace std::chrono_literals;
using test::Client;
using test::code_of;
using test::document_of;

// A job that runs until it is cancelled: caps of degree 2 with a small error take minutes of
// processor time.
Json long_job() {
  return {{"op", "compress"}, {"item", 1}, {"tolerance", 1e-4}, {"max_degree", 2}};
}

struct WithJob : Client {
  explicit WithJob(StudioOptions options = {.threads = 2}) : Client(std::move(options)) {
    step({{"op", "make"}, {"shape", "bumpy"}});
    const Response answer = post(long_job());
    EXPECT_EQ(answer.status, 202) << answer.body;
    job = Json::parse(answer.body).at("job").at("id");
  }
  int job = 0;
};

TEST(Jobs, ACancelledOneLeavesNothing) {
  WithJob client;
  const Json before = client.state();
  EXPECT_EQ(client.ask("POST", "api/job/" + std::to_string(client.job) + "/cancel").status, 200);
  const Json after = client.finished();
  EXPECT_EQ(after.at("job").at("state"), "cancelled");
  EXPECT_EQ(document_of(after), document_of(before));
  EXPECT_EQ(after.at("undo"), before.at("undo"));
  // The session can still be used.
  EXPECT_EQ(client.step({{"op", "analyze"}, {"item", 1}, {"degree", 3}}).at("job").at("state"),
            "done");
}

TEST(Jobs, OneAtATime) {
  WithJob client;
  for (const Json& step : std::vector<Json>{long_job(), {{"op", "make"}}, {{"op", "undo"}}}) {
    const Response answer = client.post(step);
    EXPECT_EQ(answer.status, 409) << step;
    EXPECT_EQ(code_of(answer), "busy") << step;
  }
  EXPECT_EQ(client.open("a.off", "OFF\n").status, 409);
  // Requests that only look are still answered.
  EXPECT_EQ(client.ask("GET", "api/item/1/surface").status, 200);
  EXPECT_EQ(client.live({{"live", "brush"}, {"item", 1}, {"points", {1}}, {"radius", 0.2}}).status,
            200);
  EXPECT_EQ(client.ask("POST", "api/job/77/cancel").status, 404);
}

TEST(Jobs, ASessionCanEndDuringOne) {
  WithJob client;
  EXPECT_EQ(client.ask("DELETE", "api/session").status, 200);
  EXPECT_EQ(client.ask("GET", "api/state").status, 404);
}

TEST(Jobs, TheStudioCanEndDuringOne) {
  WithJob client;
  client.studio.close();
  EXPECT_EQ(client.ask("GET", "api/state").status, 404);
}

TEST(Jobs, ListenersHearOfThem) {
  Client client;
  const auto listener = client.studio.listen(client.id);
  ASSERT_TRUE(listener);
  std::vector<Event> events = listener->wait(0ms);
  ASSERT_EQ(events.size(), 1U);  // the current state
  EXPECT_EQ(events[0].name, "state");
  EXPECT_TRUE(listener->wait(0ms).empty());
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.post({{"op", "analyze"}, {"item", 1}, {"degree", 6}});
  bool done = false;
  Json state;
  while (!done) {
    events = listener->wait(10s);
    ASSERT_FALSE(events.empty());
    for (const Event& event : events) {
      EXPECT_EQ(event.data.find('\n'), std::string::npos);
      if (event.name == "state") state = Json::parse(event.data);
      if (event.name == "job") done = Json::parse(event.data).at("state") == "done";
    }
  }
  EXPECT_EQ(state.at("items")[0].at("expansion").at("degree"), 6);
  EXPECT_FALSE(client.studio.listen("nobody"));
}

TEST(Jobs, ListenersWakeWhenTheSessionEnds) {
  Client client;
  const auto listener = client.studio.listen(client.id);
  listener->wait(0ms);
  std::thread end([&] {
    std::this_thread::sleep_for(20ms);
    client.ask("DELETE", "api/session");
  });
  while (!listener->ended()) EXPECT_TRUE(listener->wait(100s).empty());
  end.join();
}

TEST(Jobs, ASessionGoesSomeTimeAfterItsPage) {
  Client client({.threads = 1, .patience = 0ms});
  client.studio.tend();
  EXPECT_EQ(client.ask("GET", "api/state").status, 200);  // no page has listened yet
  auto listener = client.studio.listen(client.id);
  client.studio.tend();
  EXPECT_EQ(client.ask("GET", "api/state").status, 200);  // a page listens
  listener.reset();
  while (client.ask("GET", "api/state").status == 200) client.studio.tend();
  EXPECT_EQ(client.ask("GET", "api/state").status, 404);
}

TEST(Jobs, ASessionStaysWhileItsPageIsLoadedAgain) {
  Client client({.threads = 1, .patience = 1h});
  client.studio.listen(client.id).reset();
  client.studio.tend();
  EXPECT_EQ(client.ask("GET", "api/state").status, 200);
}

TEST(Jobs, AnswersEndWithEverythingElse) {
  std::atomic<bool> going = true;
  Client client({.threads = 1, .keep_going = [&] { return going.load(); }});
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  going = false;
  const Response answer = client.live(
      {{"live", "smooth"}, {"item", 1}, {"regions", {"vertex:5,0.4"}}, {"wavelength", 0.3}});
  EXPECT_EQ(answer.status, 422);
  EXPECT_EQ(code_of(answer), "cancelled");
  going = true;
  EXPECT_EQ(client.ask("GET", "api/item/1/surface").status, 200);
}

TEST(Jobs, SessionsDoNotSeeEachOther) {
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  const std::string first = client.id;
  client.id = Json::parse(client.ask("POST", "api/session").body).at("session");
  EXPECT_TRUE(client.state().at("items").empty());
  EXPECT_EQ(client.ask("GET", "api/item/1/surface").status, 404);
  client.post(long_job());  // fails: the item does not exist
  client.step({{"op", "make"}, {"shape", "box"}});
  client.id = first;
  EXPECT_EQ(client.state().at("items").size(), 1U);
}

TEST(Jobs, EveryPageBeginsWithWhatWasOpenedForTheFirst) {
  Client client;
  const std::string offered = client.studio.offered_session();
  client.id = offered;
  ASSERT_EQ(client.open("tip.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").status, 200);
  EXPECT_EQ(Json::parse(client.ask("POST", "api/session").body).at("session"), offered);
  // Changes by the first page do not affect later pages.
  client.step({{"op", "rename"}, {"item", 1}, {"name", "other"}});
  client.step({{"op", "make"}, {"shape", "box"}});
  client.ask("DELETE", "api/session");
  client.id = Json::parse(client.ask("POST", "api/session").body).at("session");
  EXPECT_NE(client.id, offered);
  Json state = client.state();
  ASSERT_EQ(state.at("items").size(), 1U);
  EXPECT_EQ(state.at("items")[0].at("name"), "tip.off");
  EXPECT_TRUE(state.at("undo").is_null());
  state = client.step({{"op", "make"}, {"shape", "box"}});  // the new item has its own number
  EXPECT_NE(state.at("items")[0].at("id"), state.at("items")[1].at("id"));
  EXPECT_NE(state.at("items")[0].at("revision"), state.at("items")[1].at("revision"));
}

// Returns bytes in use by this process's allocator, or 0 if another one replaces it (sanitizers).
std::size_t used() { return mallinfo2().uordblks + mallinfo2().hblkhd; }

TEST(Jobs, MemoryIsGivenBack) {
  if (used() == 0) GTEST_SKIP() << "the allocator does not tell what is in use";
  Client client;
  client.step({{"op", "make"}, {"shape", "bumpy"}});  // makes data that the library keeps
  client.step({{"op", "analyze"}, {"item", 1}, {"degree", 100}});
  client.ask("DELETE", "api/session");
  const std::size_t before = used();
  client.id = Json::parse(client.ask("POST", "api/session").body).at("session");
  client.step({{"op", "make"}, {"shape", "bumpy"}});
  client.step({{"op", "analyze"}, {"item", 1}, {"degree", 100}});
  client.live(
      {{"live", "smooth"}, {"item", 1}, {"regions", {"vertex:5,0.4"}}, {"wavelength", 0.3}});
  const std::size_t during = used();
  client.ask("DELETE", "api/session");
  const std::size_t after = used();
  EXPECT_GT(during, before + 4000000);  // the degrees of 10 242 vertices alone are 4.1 MB
  EXPECT_LT(after, before + 500000);
}

TEST(Jobs, APageThatIsClosedTakesItsJobAlong) {
  if (used() == 0) GTEST_SKIP() << "the allocator does not tell what is in use";
  WithJob client({.threads = 1, .patience = 0ms});
  client.ask("POST", "api/job/" + std::to_string(client.job) + "/cancel");
  client.finished();  // data that the library keeps exists now
  const std::size_t before = used();
  ASSERT_EQ(client.post(long_job()).status, 202);
  while (used() < before + 4000000) std::this_thread::sleep_for(1ms);
  client.studio.tend();
  EXPECT_GT(used(), before + 3000000);  // no page has left
  client.studio.listen(client.id).reset();
  while (client.studio.listen(client.id)) client.studio.tend();  // no request asks for the result
  EXPECT_LT(used(), before);
}

TEST(Jobs, TemporaryFilesGo) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "rholm-studio-jobs-test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  {
    Client client({.folder = folder, .threads = 1});
    client.step({{"op", "make"}, {"shape", "box"}});
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    EXPECT_EQ(client.save(1, "ply").status, 200);
    const auto own = *std::filesystem::directory_iterator(folder);
    for (const auto& left : std::filesystem::directory_iterator(own)) {
      EXPECT_EQ(left.path().filename(), kFolderLock);  // while the studio runs
    }
    EXPECT_EQ(std::filesystem::status(own).permissions(), std::filesystem::perms::owner_all);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove(folder);
}

}  // namespace
}  // namespace rholm::studio
