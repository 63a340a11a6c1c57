#include "cli/grammar/completion.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "cli/terminal/session.h"

namespace rholm::cli {

std::vector<std::string> offered_extensions(Offer offer) {
  std::vector<std::string> shapes = {"ply", "obj", "off", "stl", "xyz", "pwn", "pts", "csv", "txt"};
  std::vector<std::string> coefficients = {"h5",  "sh",    "shtools", "gfc",
                                           "txt", "icgem", "json",    "npy"};
  switch (offer) {
    case Offer::kShapes:
      return shapes;
    case Offer::kCoefficients:
      return coefficients;
    case Offer::kShapesAndCoefficients: {
      std::vector<std::string> both = shapes;
      for (const std::string& extension : coefficients) {
        if (extension != "txt") both.push_back(extension);
      }
      return both;
    }
    case Offer::kNothing:
    case Offer::kAnyFile:
      break;
  }
  return {};
}

std::vector<Command> offered_commands(std::span<const Command> commands) {
  std::vector<Command> offered;
  std::copy_if(commands.begin(), commands.end(), std::back_inserter(offered),
               [](const Command& command) { return !command.hidden; });
  return offered;
}

std::vector<Option> offered_options(const Command& command) {
  static bool help = false;
  static CommonOptions common;  // targets nobody reads: the options are only looked at
  std::vector<Option> options = command.options;
  for (const Option& option : common_options(common)) options.push_back(option);
  options.push_back({.name = "help", .letter = 'h', .help = "what it does", .target = &help});
  return options;
}

std::string of_program(std::string text, const std::string& program) {
  std::string function = program;
  std::replace(function.begin(), function.end(), '-', '_');
  for (const auto& [mark, name] :
       {std::pair<std::string, std::string>{"@program@", program}, {"@function@", function}}) {
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at)) {
      text.replace(at, mark.size(), name);
    }
  }
  return text;
}

std::string first_clause(const std::string& help) {
  return help.substr(0, std::min({help.find(';'), help.find(':'), help.find(" (")}));
}

}  // namespace rholm::cli
