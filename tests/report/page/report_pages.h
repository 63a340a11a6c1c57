// Checks that every page of a report must pass.
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "rholm/report.h"

namespace rholm::test {

inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// Returns the tags of a page in order, without angle brackets.
inline std::vector<std::string> tags_of(const std::string& html) {
  std::vector<std::string> tags;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    tags.push_back(html.substr(at + 1, html.find('>', at) - at - 1));
  }
  return tags;
}

// Returns true if every element that needs an end tag is closed in the right order.
inline bool is_balanced(const std::string& html) {
  static const std::set<std::string> kVoid = {"!DOCTYPE", "meta", "img", "br"};
  std::vector<std::string> open;
  for (const std::string& tag : tags_of(html)) {
    const std::string name = tag.substr(0, tag.find_first_of(" \n"));
    if (kVoid.count(name) > 0 || tag.back() == '/') continue;
    if (tag[0] != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

// Checks a page for the properties of all pages.
inline void expect_decent(const std::string& html) {
  EXPECT_TRUE(is_balanced(html));
  EXPECT_EQ(count(html, "<html lang=\"en\">"), 1u);
  EXPECT_EQ(count(html, "<h1>"), 1u);
  EXPECT_EQ(count(html, "<script"), 0u);
  EXPECT_EQ(count(html, "http:") + count(html, "https:") + count(html, "@import"), 0u);
  EXPECT_EQ(count(html, "url("), count(html, "url(#"));
  EXPECT_EQ(count(html, "nan") + count(html, "inf,") + count(html, ">inf"), 0u);
  for (const std::string& tag : tags_of(html)) {
    if (tag.starts_with("img ")) {
      EXPECT_NE(tag.find("src=\"data:image/png;base64,"), std::string::npos);
      EXPECT_NE(tag.find(" alt=\"P"), std::string::npos);
    }
    if (tag.starts_with("th ") || tag == "th") {
      EXPECT_NE(tag.find("scope="), std::string::npos) << tag;
    }
    EXPECT_EQ(tag.find("href"), std::string::npos) << tag;
  }
}

inline ReportOptions small_pictures() {
  ReportOptions options{.title = "a.h5", .shape_name = "a.ply"};
  options.picture_size = 24;
  return options;
}

}  // namespace rholm::test
