// rholm completion: what the shells offer.
#include "cli/completion.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace rholm::cli {
namespace {

struct Options {
  std::string shell;
};

int run(const Options& options) {
  const std::vector<Command> commands = all_commands();
  const std::string text = options.shell == "bash"  ? bash_completion(commands)
                           : options.shell == "zsh" ? zsh_completion(commands)
                                                    : fish_completion(commands);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return 0;
}

}  // namespace

std::vector<std::string> offered_extensions(Offer offer) {
  const std::vector<std::string> shapes = {"ply", "obj", "off", "stl", "xyz", "pwn", "txt"};
  const std::vector<std::string> coefficients = {"h5",  "sh",    "shtools", "gfc",
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

std::string first_clause(const std::string& help) {
  return help.substr(0, std::min({help.find(';'), help.find(':'), help.find(" (")}));
}

Command completion_command() {
  auto options = std::make_shared<Options>();
  return {.name = "completion",
          .summary = "Completions for a shell",
          .description =
              "Writes to standard output what makes a shell complete rholm's commands, options "
              "and files. An installed rholm has brought them along; this is for one that runs "
              "from where it was built.",
          .options = {{.name = "SHELL",
                       .help = "bash, zsh or fish",
                       .target = &options->shell,
                       .required = true,
                       .choices = {"bash", "zsh", "fish"}}},
          .examples = {"rholm completion bash > rholm.bash"},
          .run = [options](Session&) { return run(*options); }};
}

}  // namespace rholm::cli
