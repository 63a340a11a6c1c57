#include "cli/grammar/completion.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "cli/terminal/session.h"
#include "rholm/formats.h"

namespace rholm::cli {

std::vector<std::string> offered_extensions(Offer offer) {
  std::vector<std::string> offered;
  const auto add = [&](const auto& formats) {
    for (const auto& format : formats) {
      if (!format.file.read) continue;
      for (const FileExtension& extension : format.file.extensions) {
        const bool is_there =
            std::find(offered.begin(), offered.end(), extension.name) != offered.end();
        if (!is_there) offered.push_back(extension.name);
      }
    }
  };
  const bool both = offer == Offer::kShapesAndCoefficients;
  if (both || offer == Offer::kShapes) add(shape_formats());
  if (both || offer == Offer::kCoefficients) add(coefficients_formats());
  return offered;
}

std::vector<Command> offered_commands(std::span<const Command> commands) {
  std::vector<Command> offered;
  std::copy_if(commands.begin(), commands.end(), std::back_inserter(offered),
               [](const Command& command) { return !command.hidden; });
  return offered;
}

std::vector<Option> offered_options(const Command& command) {
  static bool help = false;
  static CommonOptions common;  // unused targets: only the options are needed
  std::vector<Option> options = command.options;
  for (const Option& option : common_options(common)) options.push_back(option);
  options.push_back({.name = "help", .letter = 'h', .help = "print help", .target = &help});
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
