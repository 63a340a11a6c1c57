// rholm studio: editing of shapes in the browser.
#include <cstdlib>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/paths.h"
#include "cli/options/field_options.h"
#include "cli/options/memory_options.h"
#include "cli/studio/browser.h"
#include "cli/studio/page.h"
#include "cli/studio/server.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/error_info.h"
#include "rholm/studio.h"

namespace rholm::cli {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string columns;
  std::optional<int> port;
  bool no_open = false;
  StudioOptions studio;
  std::string page;
};

// Throws the studio's refusal of a file as an error of the program.
[[noreturn]] void throw_refused(const std::string& path, const StudioResponse& answer) {
  const Json error = Json::parse(answer.body).at("error");
  const std::string code = error.at("code").get<std::string>();
  const std::string message = error.at("message").get<std::string>();
  ErrorCode kind = ErrorCode::kInvalidInput;
  for (const ErrorInfo& info : error_infos()) {
    if (code == snake_case_name(info.code)) kind = info.code;
  }
  throw Error(kind, message.find(path) == std::string::npos ? display_name(path) + ": " + message
                                                            : message);
}

// Opens files for the first page.
void open_files(const Options& options, Studio& studio) {
  if (options.files.empty()) return;
  const std::string session = studio.offered_session();
  for (const std::string& path : options.files) {
    const std::vector<char> bytes = read_all_bytes(path);
    const StudioResponse answer = studio.handle(
        {.method = "POST",
         .path = "api/file",
         .query = {{"name", path == "-" ? "input" : path}, {"columns", options.columns}},
         .body = {bytes.begin(), bytes.end()},
         .session = session});
    stop_if_interrupted();
    if (answer.status != 200) throw_refused(path, answer);
  }
}

int run(const Options& options, Session& session) {
  const std::string folder = MemoryOptions{}.folder();
  StudioOptions wanted = options.studio;
  wanted.folder = folder;
  wanted.threads = session.context().threads;
  wanted.keep_going = keep_going;
  Studio studio(wanted);
  open_files(options, studio);
  StudioServer server(studio, options.page.empty() ? own_page() : read_page(options.page),
                      {.port = options.port.value_or(0), .max_upload = wanted.max_upload});
  print_note(fmt::format("the studio is at {}", server.address()));
  std::optional<Browser> browser;
  if (!options.no_open) {
    browser.emplace(server.address(), folder);
    if (!browser->opened()) session.note("no browser could be opened; open the address yourself");
  }
  session.note("Ctrl-C ends the studio");
  server.run([&] { return interrupting_signal() != 0 || studio.quitting(); });
  return kDone;
}

std::vector<Option> option_list(Options& o) {
  return {{.name = "FILES",
           .help = "shapes, models and sessions to open",
           .target = &o.files,
           .offer = Offer::kShapesAndCoefficients},
          columns_option(o.columns),
          {.name = "port",
           .value = "N",
           .help = "port to listen on; by default a free port",
           .target = &o.port,
           .min = 1,
           .max = 65535},
          {.name = "no-open", .help = "do not open the browser", .target = &o.no_open},
          field_option_of(o.studio, "max_upload"),
          {.name = "page",
           .value = "DIR",
           .help = "folder of the page; by default the installed page",
           .target = &o.page}};
}

}  // namespace

Command studio_command() {
  auto options = std::make_shared<Options>();
  return {.name = "studio",
          .summary = "Work with shapes in the browser",
          .description =
              "Opens a page in the browser for work with shapes: view, expand, smooth, transfer "
              "detail, reconstruct and save. Every step can be undone, and the page shows the "
              "commands that do the same.\n\nThe page is served on this computer only. Its address "
              "contains a key: keep it secret. Ctrl-C or the button of the page ends the studio "
              "with exit code 0. Unsaved work is then lost.",
          .options = in_groups(option_list(*options), {{Group::kAdvanced, {"page"}}}),
          .examples = {"rholm studio bumpy.ply"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
