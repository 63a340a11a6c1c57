#include "cli/options/convention.h"

#include <fmt/format.h>

#include "cli/options/field_options.h"

namespace rholm::cli {
namespace {

int phase_of(const std::string& text) { return text == "-1" ? -1 : 1; }

// Makes the options of both fields of Convention. Their values are texts, which may be empty;
// `where` is a part of the help.
std::vector<Option> options_of(const std::string& prefix, std::string& normalization,
                               std::string& csphase, const std::string& where) {
  const Convention standard;
  std::vector<Option> options;
  for_each_field<Convention>([&](auto member, const FieldInfo& info) {
    using V = std::remove_cvref_t<decltype(standard.*member)>;
    Option option = option_of(info, "");
    option.name = prefix + option.name;
    option.value = {};
    option.min = option.max = {};
    if constexpr (NamedEnum<V>) {
      option.help += fmt::format("{}; {} by default", where, to_string(standard.*member));
      const auto names = names_of(V{}).names;
      option.choices.assign(names.begin(), names.end());
      option.target = &normalization;
    } else {
      option.help = fmt::format("Condon-Shortley phase{}: {}; {} by default", where, option.help,
                                standard.*member);
      option.choices = {"1", "-1"};
      option.target = &csphase;
    }
    options.push_back(std::move(option));
  });
  return options;
}

}  // namespace

Convention ConventionOptions::output_convention() const {
  return {parse_name<Normalization>(normalization), phase_of(csphase)};
}

std::vector<Option> convention_options(ConventionOptions& target) {
  return options_of("", target.normalization, target.csphase, " in text, JSON and NumPy files");
}

CoefficientsReadOptions InputConvention::reading() const {
  CoefficientsReadOptions options;
  if (!normalization.empty())
    options.convention.normalization = parse_name<Normalization>(normalization);
  options.convention.csphase = phase_of(csphase);
  options.override_file = override_file;
  return options;
}

std::vector<std::string> InputConvention::left_open(const std::vector<std::string>& assumed) const {
  std::vector<std::string> open;
  for (const std::string& what : assumed) {
    const bool given = (what.starts_with("normalization ") && !normalization.empty()) ||
                       (what.starts_with("csphase ") && !csphase.empty());
    if (!given) open.push_back(what);
  }
  return open;
}

std::vector<Option> input_convention_options(InputConvention& target) {
  return options_of("input-", target.normalization, target.csphase,
                    ", for an input whose file does not state it");
}

std::string text_of(const Convention& convention) {
  return fmt::format("normalization {}, csphase {}", to_string(convention.normalization),
                     convention.csphase);
}

}  // namespace rholm::cli
