// A foreign program that uses a part of every installed header. Usage: consumer
// INSTALLED_HEADERS_FOLDER; it fails if a header of the folder has no check.
#include "check.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <set>
#include <stdexcept>

void expect(bool holds, const std::string& claim) {
  if (!holds) throw std::runtime_error("not so: " + claim);
}

void expect_near(double value, double expected, double tolerance, const std::string& name) {
  expect(std::abs(value - expected) <= tolerance,
         name + " is " + std::to_string(value) + ", not " + std::to_string(expected));
}

namespace {

std::vector<HeaderCheck> all_checks() {
  std::vector<HeaderCheck> all;
  for (auto* group : {base_checks, harmonic_checks, shape_checks, file_checks, star_checks,
                      surface_checks, edit_checks, model_checks, report_checks}) {
    for (const HeaderCheck& check : group()) all.push_back(check);
  }
  return all;
}

// Returns names of installed headers without a check, and of checks whose header is not installed.
std::vector<std::string> mismatches(const std::filesystem::path& folder,
                                    const std::vector<HeaderCheck>& checks) {
  std::set<std::string> installed;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    installed.insert(entry.path().filename().string());
  }
  std::vector<std::string> found;
  std::set<std::string> checked;
  for (const HeaderCheck& check : checks) {
    checked.insert(check.header);
    if (!installed.contains(check.header)) found.push_back("not installed: " + check.header);
  }
  for (const std::string& header : installed) {
    if (!checked.contains(header)) found.push_back("installed, but not used: " + header);
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: consumer INSTALLED_HEADERS_FOLDER\n");
    return 2;
  }
  const std::vector<HeaderCheck> checks = all_checks();
  const std::vector<std::string> missing = mismatches(argv[1], checks);
  for (const std::string& line : missing) std::fprintf(stderr, "consumer: %s\n", line.c_str());
  int failures = static_cast<int>(missing.size());
  for (const HeaderCheck& check : checks) {
    try {
      check.run();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "consumer: %s: %s\n", check.header.c_str(), error.what());
      ++failures;
    }
  }
  std::printf("consumer: %zu headers used, %d failures\n", checks.size(), failures);
  return failures == 0 ? 0 : 1;
}
