// rholm man-page: the manual page.
#include <cstdio>
#include <memory>

#include "cli/commands/commands.h"
#include "cli/grammar/help.h"
#include "cli/terminal/exit_code.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string date = "1970-01-01";
};

int run(const Options& options) {
  const std::string text = man_page(all_commands(), options.date);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return kDone;
}

}  // namespace

Command man_page_command() {
  auto options = std::make_shared<Options>();
  return {.name = "man-page",
          .summary = "Write the manual page",
          .description = "Writes the manual page in troff's man macros to standard output.",
          .options = {{.name = "date",
                       .value = "YYYY-MM-DD",
                       .help = "the date it bears",
                       .target = &options->date}},
          .examples = {"rholm man-page --date 2000-01-01 | man -l -"},
          .run = [options](Session&) { return run(*options); },
          .hidden = true};
}

}  // namespace rholm::cli
