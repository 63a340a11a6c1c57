#include "cli/region_option.h"

#include <fmt/format.h>

#include "cli/parse.h"
#include "rholm/error.h"

namespace rholm::cli {

Option region_option(const std::string& name, const std::string& help,
                     std::vector<std::string>& texts) {
  return {.name = name, .value = "R", .help = help, .target = &texts, .required = true};
}

std::vector<Region> parse_regions(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<Region> regions;
  for (const std::string& text : texts) {
    try {
      regions.push_back(parse_region(text));
    } catch (const Error& error) {
      throw UsageError(fmt::format("--{}: {}", name, error.what()));
    }
  }
  return regions;
}

}  // namespace rholm::cli
