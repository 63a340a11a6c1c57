#include "cli/options/region_option.h"

#include "cli/grammar/values.h"

namespace rholm::cli {

Option region_option(const std::string& name, const std::string& help,
                     std::vector<std::string>& texts) {
  return {.name = name,
          .value = "R",
          .help = help,
          .target = &texts,
          .required = true,
          .check = [](const std::string& option, const std::string& text) {
            check_by(option, text, [&] { parse_region(text); });
          }};
}

std::vector<Region> parse_regions(const std::vector<std::string>& texts) {
  std::vector<Region> regions;
  regions.reserve(texts.size());
  for (const std::string& text : texts) regions.push_back(parse_region(text));
  return regions;
}

}  // namespace rholm::cli
