// The one user of CLI11. It splits words into options and converts numbers; choices and bounds are
// checked here, so that a message always has the value, the limit, and NaN is refused.
#include "cli/parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rholm::cli {
namespace {

std::string cli11_name(const Option& option) {
  if (option.is_operand()) return option.name;
  return option.letter ? fmt::format("-{},--{}", option.letter, option.name) : "--" + option.name;
}

void add(CLI::App& app, const Option& option) {
  const std::string name = cli11_name(option);
  CLI::Option* added = std::visit(
      [&](auto target) -> CLI::Option* {
        using T = decltype(target);
        if constexpr (std::is_same_v<T, std::monostate>) {
          throw std::logic_error("option without a target: " + name);
        } else if constexpr (std::is_same_v<T, bool*>) {
          return app.add_flag(name, *target);
        } else if constexpr (std::is_same_v<T, std::vector<std::string>*>) {
          // An option that may come several times has one value each time.
          return app.add_option(name, *target)->allow_extra_args(option.is_operand());
        } else {
          return app.add_option(name, *target);
        }
      },
      option.target);
  if (option.required) added->required();
}

void check_bounds(const Option& option, double value) {
  const double min = option.min.value_or(-std::numeric_limits<double>::max());
  const double max = option.max.value_or(std::numeric_limits<double>::max());
  if (value >= min && value <= max) return;  // false for NaN
  const std::string limits = option.max   ? fmt::format("within {} ... {}", min, max)
                             : option.min ? fmt::format("a finite number from {} up", min)
                                          : std::string("a finite number");
  throw UsageError(fmt::format("{} is {}; it must be {}", option.typed(), value, limits));
}

void check_choice(const Option& option, const std::string& value) {
  if (option.choices.empty()) return;
  if (std::find(option.choices.begin(), option.choices.end(), value) != option.choices.end())
    return;
  throw UsageError(fmt::format("{} is '{}'; it must be one of {}", option.typed(), value,
                               fmt::join(option.choices, ", ")));
}

void check(const Option& option) {
  std::visit(
      [&](auto target) {
        using T = decltype(target);
        if constexpr (std::is_same_v<T, int*> || std::is_same_v<T, double*> ||
                      std::is_same_v<T, std::uint64_t*>) {
          check_bounds(option, static_cast<double>(*target));
        } else if constexpr (std::is_same_v<T, std::optional<int>*> ||
                             std::is_same_v<T, std::optional<double>*>) {
          if (*target) check_bounds(option, static_cast<double>(**target));
        } else if constexpr (std::is_same_v<T, std::string*>) {
          if (!target->empty()) check_choice(option, *target);
        }
      },
      option.target);
}

}  // namespace

void parse(const Command& command, std::span<const std::string> words, CommonOptions& common) {
  CLI::App app(command.summary, command.name);
  app.set_help_flag();  // --help is answered before the parser is asked
  std::vector<Option> options = command.options;
  for (Option& option : common_options(common)) options.push_back(std::move(option));
  for (const Option& option : options) add(app, option);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 wants them reversed
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  for (const Option& option : options) check(option);
}

}  // namespace rholm::cli
