// Parsing with CLI11, which only this file uses. It splits words into options. Values are converted
// and checked here, so that every message has the option, the value and the limit, and NaN is
// refused.
#include "cli/grammar/parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/grammar/old_names.h"
#include "cli/grammar/suggest.h"
#include "cli/grammar/values.h"

namespace rholm::cli {
namespace {

// An option of CLI11: it fills switches and lists itself; any other value is a text.
struct Word {
  const Option* option;
  CLI::Option* known = nullptr;
  std::string text = {};
};

std::string cli11_name(const Option& option) {
  if (option.is_operand()) return option.name;
  return option.letter ? fmt::format("-{},--{}", option.letter, option.name) : "--" + option.name;
}

void add(CLI::App& app, Word& word) {
  const Option& option = *word.option;
  const std::string name = cli11_name(option);
  if (std::holds_alternative<std::monostate>(option.target)) {
    throw std::logic_error("option without a target: " + name);
  }
  if (const auto* target = std::get_if<bool*>(&option.target)) {
    word.known = app.add_flag(name, **target);
  } else if (const auto* list = std::get_if<std::vector<std::string>*>(&option.target)) {
    // An option that may be repeated takes one value each time.
    word.known = app.add_option(name, **list)->allow_extra_args(option.is_operand());
  } else {
    word.known = app.add_option(name, word.text)->type_name("value");
  }
  if (option.required) word.known->required();
}

[[noreturn]] void refuse(const Option& option, const std::string& text, const std::string& limits) {
  throw UsageError(fmt::format("{} is '{}'; it must be {}", option.typed(), text, limits));
}

void check_text(const Option& option, const std::string& text) {
  if (text.empty()) {
    throw UsageError(fmt::format("{} is empty; it needs a value{}", option.typed(),
                                 option.value.empty() ? "" : ", " + option.value));
  }
  if (!option.choices.empty() &&
      std::find(option.choices.begin(), option.choices.end(), text) == option.choices.end()) {
    refuse(option, text,
           fmt::format("one of {}", fmt::join(option.choices, ", ")) +
               did_you_mean(text, option.choices));
  }
  if (option.check) option.check(option.typed(), text);
}

// Limits are inclusive. Every int and every seed is exact as a double, or far from the limits.
template <typename Number>
Number whole_number(const Option& option, const std::string& text) {
  const double min = option.min.value_or(static_cast<double>(std::numeric_limits<Number>::min()));
  const double max = option.max.value_or(static_cast<double>(std::numeric_limits<Number>::max()));
  Number number = 0;
  const bool read = read_whole(text, number);
  if (read && static_cast<double>(number) >= min && static_cast<double>(number) <= max) {
    return number;
  }
  refuse(option, text, fmt::format("a whole number within {:.0f} ... {:.0f}", min, max));
}

void take(const Option& option, const std::string& text) {
  check_text(option, text);
  std::visit(
      [&](const auto& target) {
        using T = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<T, int*> || std::is_same_v<T, std::optional<int>*>) {
          *target = whole_number<int>(option, text);
        } else if constexpr (std::is_same_v<T, std::uint64_t*>) {
          *target = whole_number<std::uint64_t>(option, text);
        } else if constexpr (std::is_same_v<T, double*> ||
                             std::is_same_v<T, std::optional<double>*>) {
          *target = number_within(option, text);
        } else if constexpr (std::is_same_v<T, std::string*>) {
          *target = option.meaning ? option.meaning(text) : text;
        } else if constexpr (std::is_same_v<T, TakeText>) {
          target(option.typed(), text);
        }
      },
      option.target);
}

// Returns the ways to type an option: "--degree", "-o".
std::vector<std::string> names_of(const std::vector<Option>& options) {
  std::vector<std::string> names = {"--help"};
  for (const Option& option : options) {
    if (option.is_operand()) continue;
    names.push_back(option.typed());
    if (option.letter) names.push_back({'-', option.letter});
  }
  return names;
}

const Option* option_of(const std::vector<Option>& options, std::string_view name) {
  const auto is_named = [&](const Option& option) {
    return !option.is_operand() &&
           (name == option.typed() || (option.letter && name == std::string{'-', option.letter}));
  };
  const auto found = std::find_if(options.begin(), options.end(), is_named);
  return found == options.end() ? nullptr : &*found;
}

// Refuses unknown options, options without their value, and values given twice. CLI11 would take
// the value of an unknown option for an operand, and report that.
void check_names(const std::vector<Option>& options, std::span<const std::string> words) {
  std::vector<const Option*> seen;  // with a value
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--") return;  // operands follow
    const bool is_long = word.starts_with("--");
    const bool is_number =
        word.size() > 1 && (word[1] == '.' || (word[1] >= '0' && word[1] <= '9'));
    if (word.size() < 2 || word[0] != '-' || is_number) continue;
    const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
    const Option* option = option_of(options, name);
    if (option == nullptr) {
      const std::string typed = is_long ? name : word;
      const std::string hint = option_hint(typed);
      throw UsageError(fmt::format("there is no option '{}'{}", typed,
                                   hint.empty() ? did_you_mean(typed, names_of(options)) : hint));
    }
    if (option->is_switch()) continue;
    const bool is_list = std::holds_alternative<std::vector<std::string>*>(option->target);
    if (!is_list && std::find(seen.begin(), seen.end(), option) != seen.end()) {
      throw UsageError(fmt::format("{} is given twice", name));
    }
    seen.push_back(option);
    if (word.size() != name.size()) continue;
    ++i;  // its value, even if it looks like an option
    if (i == words.size()) {
      throw UsageError(fmt::format("{} needs a value{}", name,
                                   option->value.empty() ? "" : ", " + option->value));
    }
  }
}

}  // namespace

double number_within(const Option& option, const std::string& text) {
  const std::optional<double> number = read_number(text);
  const double min = option.min.value_or(-std::numeric_limits<double>::max());
  const double max = option.max.value_or(std::numeric_limits<double>::max());
  const bool inside =
      number && *number >= min && *number <= max && !(option.above && *number <= *option.above);
  if (inside) return *number;
  const std::string limits = option.above ? fmt::format("a finite number above {}", *option.above) +
                                                (option.max ? fmt::format(", at most {}", max) : "")
                             : option.max ? fmt::format("a number within {} ... {}", min, max)
                             : option.min ? fmt::format("a finite number from {} up", min)
                                          : std::string("a finite number");
  refuse(option, text, limits);
}

std::uint64_t whole_within(const Option& option, const std::string& text) {
  return whole_number<std::uint64_t>(option, text);
}

void parse(const Command& command, std::span<const std::string> words, CommonOptions& common) {
  CLI::App app(command.summary, command.name);
  app.set_help_flag();  // --help is handled before parsing
  std::vector<Option> options = command.options;
  for (Option& option : common_options(common)) options.push_back(std::move(option));
  check_names(options, words);
  std::deque<Word> known;  // CLI11 keeps references to the texts
  for (const Option& option : options) add(app, known.emplace_back(Word{&option}));
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 needs them reversed
  } catch (const CLI::ExtrasError&) {
    throw UsageError(fmt::format("'{}' is one operand too many", app.remaining().front()));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  for (const Word& word : known) {
    if (word.known->count() == 0 || word.option->is_switch()) continue;
    if (const auto* list = std::get_if<std::vector<std::string>*>(&word.option->target)) {
      for (const std::string& text : **list) check_text(*word.option, text);
    } else {
      take(*word.option, word.text);
    }
  }
}

}  // namespace rholm::cli
