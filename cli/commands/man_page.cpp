// rholm man-page: the manual page, also for other programs.
#include <memory>
#include <utility>

#include "cli/commands/commands.h"
#include "cli/grammar/help.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/session.h"

namespace rholm::cli {

Command man_page_command(const std::string& program, PageOfDate page) {
  auto date = std::make_shared<std::string>("1970-01-01");
  return {.name = "man-page",
          .summary = "Print the manual page",
          .description = "Prints the manual page in the man macros of troff.",
          .options = {{.name = "date",
                       .value = "YYYY-MM-DD",
                       .help = "date on the page",
                       .target = date.get()}},
          .examples = {program + " man-page --date 2000-01-01 | man -l -"},
          .run =
              [date, page = std::move(page)](Session&) {
                print_exactly(page(*date));
                return kDone;
              },
          .hidden = true};
}

Command man_page_command() {
  return man_page_command("rholm", [](const std::string& date) {
    return man_page(rholm_text(), all_commands(), date);
  });
}

}  // namespace rholm::cli
