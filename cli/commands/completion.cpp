// rholm completion: completions for shells.
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands/commands.h"
#include "cli/grammar/completion.h"
#include "cli/terminal/exit_code.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string shell;
};

int run(const Options& options, const std::string& program, const std::vector<Command>& commands) {
  const std::string text = options.shell == "bash"  ? bash_completion(program, commands)
                           : options.shell == "zsh" ? zsh_completion(program, commands)
                                                    : fish_completion(program, commands);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return kDone;
}

}  // namespace

Command completion_command(const std::string& program, ListCommands commands) {
  auto options = std::make_shared<Options>();
  return {
      .name = "completion",
      .summary = "Print the completion script of a shell",
      .description =
          "Prints a script that makes a shell complete the commands, options and files of " +
          program + ". An installed " + program +
          " includes the scripts; this command is for a program that was built and not installed.",
      .options = {{.name = "SHELL",
                   .help = "bash, zsh or fish",
                   .target = &options->shell,
                   .required = true,
                   .choices = {"bash", "zsh", "fish"}}},
      .examples = {program + " completion bash > " + program + ".bash"},
      .run = [options, program, commands = std::move(commands)](Session&) {
        return run(*options, program, commands());
      }};
}

Command completion_command() { return completion_command("rholm", all_commands); }

}  // namespace rholm::cli
