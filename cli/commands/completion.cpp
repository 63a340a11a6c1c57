// rholm completion: what the shells offer.
#include <cstdio>
#include <memory>

#include "cli/commands/commands.h"
#include "cli/grammar/completion.h"
#include "cli/terminal/exit_code.h"

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
  return kDone;
}

}  // namespace

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
