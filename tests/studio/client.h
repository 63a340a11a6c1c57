// A page without a browser: it sends requests and reads the answers.
#pragma once

#include <chrono>
#include <cstring>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "rholm/studio.h"
#include "studio/items/fields.h"
#include "studio/items/message.h"

namespace rholm::studio::test {

// An array in a binary answer.
struct Array {
  std::string type, bytes;
  std::vector<std::size_t> shape;
  template <typename T>
  std::vector<T> as() const {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
  }
};

// Reads a binary answer and checks that it has the format in docs/studio.md.
inline std::map<std::string, Array> arrays_of(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 8), std::string("RHOLM1\0\0", 8));
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 8, 4);
  EXPECT_EQ((12 + length) % 8, 0U);
  const Json head = Json::parse(bytes.substr(12, length));
  std::map<std::string, Array> arrays;
  std::size_t end = 12 + length;
  for (const Json& one : head.at("arrays")) {
    Array array = {.type = one.at("type"), .bytes = {}, .shape = one.at("shape")};
    std::size_t size = array.type == "u8" ? 1 : 4;
    for (const std::size_t n : array.shape) size *= n;
    const std::size_t offset = one.at("offset");
    EXPECT_EQ(offset % 8, 0U);
    EXPECT_EQ(offset, (end + 7) / 8 * 8);
    end = offset + size;
    array.bytes = bytes.substr(offset, size);
    EXPECT_EQ(array.bytes.size(), size);
    arrays[one.at("name")] = array;
  }
  EXPECT_EQ(bytes.size(), (end + 7) / 8 * 8);
  return arrays;
}

class Client {
 public:
  explicit Client(StudioOptions options = {.threads = 2}) : studio(std::move(options)) {
    id = Json::parse(ask("POST", "api/session").body).at("session");
  }

  Response ask(const std::string& method, const std::string& path, const std::string& body = {},
               const std::map<std::string, std::string>& query = {}) {
    return studio.handle(
        {.method = method, .path = path, .query = query, .body = body, .session = id});
  }
  Json state() { return Json::parse(ask("GET", "api/state").body); }
  Response post(const Json& step) { return ask("POST", "api/step", step.dump()); }
  Response live(const Json& look) { return ask("POST", "api/live", look.dump()); }
  Response open(const std::string& name, const std::string& bytes) {
    return ask("POST", "api/file", bytes, {{"name", name}});
  }
  Response save(int item, const std::string& format, const std::string& size = {}) {
    return ask("GET", "api/save", {},
               {{"item", std::to_string(item)}, {"format", format}, {"size", size}});
  }
  // Returns the state after the step; waits for its job.
  Json step(const Json& wanted) {
    const Response answer = post(wanted);
    EXPECT_TRUE(answer.status == 200 || answer.status == 202) << wanted.dump() << answer.body;
    return answer.status == 202 ? finished() : Json::parse(answer.body);
  }
  // Returns the state when no job runs any more.
  Json finished() {
    Json now = state();
    while (now.at("job").is_object() && now.at("job").at("state") == "running") {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      now = state();
    }
    return now;
  }

  Studio studio;
  std::string id;
};

inline int last_item(const Json& state) { return state.at("items").back().at("id"); }

// Returns the code of the error in an answer, or "" if there is none.
inline std::string code_of(const Response& answer) {
  if (answer.status < 400) return "";
  return Json::parse(answer.body).at("error").at("code");
}

// Returns the part of a state that undo restores.
inline Json document_of(const Json& state) {
  return {{"items", state.at("items")}, {"recipe", state.at("recipe")}};
}

}  // namespace rholm::studio::test
