#include "cli/grammar/command.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "cli/terminal/session.h"

namespace rholm::cli {

std::vector<Option> common_options(CommonOptions& values) {
  return {
      {.name = "threads",
       .value = "N",
       .help = "number of worker threads, 0 for one per processor; 0 by default. The result does "
               "not depend on it",
       .target = &values.threads,
       .min = 0,
       .max = 4096,
       .group = Group::kAdvanced},
      {.name = "quiet",
       .help = "print errors and the report that was asked for, and no notes, warnings or progress",
       .target = &values.quiet,
       .group = Group::kAdvanced},
  };
}

std::vector<Option> described_options(const Command& command, Group group) {
  static CommonOptions unused;
  std::vector<Option> all = command.options, chosen;
  append(all, common_options(unused));
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen),
               [&](const Option& option) { return !option.is_operand() && option.group == group; });
  return chosen;
}

std::vector<Option> operands_of(const Command& command) {
  std::vector<Option> operands;
  std::copy_if(command.options.begin(), command.options.end(), std::back_inserter(operands),
               [](const Option& option) { return option.is_operand(); });
  return operands;
}

Option json_option(bool& json) {
  return {.name = "json",
          .help = "print the report as JSON on standard output",
          .target = &json,
          .group = Group::kOutput};
}

void append(std::vector<Option>& list, std::vector<Option> more) {
  for (Option& option : more) list.push_back(std::move(option));
}

std::vector<Option> in_groups(std::vector<Option> list, const std::vector<NamesInGroup>& groups) {
  for (const auto& [group, names] : groups) {
    for (const std::string& name : names) {
      const auto found = std::find_if(list.begin(), list.end(),
                                      [&](const Option& option) { return option.name == name; });
      if (found == list.end()) throw std::logic_error("no option to group: " + name);
      found->group = group;
    }
  }
  return list;
}

}  // namespace rholm::cli
