#include "cli/grammar/old_names.h"

#include <string_view>

#include <fmt/format.h>

namespace rholm::cli {
namespace {

struct OldName {
  std::string_view command, old_name, name;
};
constexpr OldName kOldNames[] = {{"align", "--center", "--centers"},
                                 {"align", "--method", "--start"},
                                 {"make", "--axis", "--pattern-axis"},
                                 {"make", "--misalign", "--misalignment"},
                                 {"make", "--noise-per-scan", "--scan-noise"},
                                 {"make", "--ratio", "--pattern-ratio"},
                                 {"orient", "--k", "--neighbors"},
                                 {"reconstruct", "--brick-points", "--tile-points"},
                                 {"smooth", "--fit", "--fitting"}};

}  // namespace

std::vector<std::string> replace_old_names(const Command& command,
                                           std::vector<std::string>& words) {
  std::vector<std::string> notes;
  for (std::string& word : words) {
    if (word == "--") break;  // operands follow
    for (const OldName& old : kOldNames) {
      if (command.name != old.command || word.substr(0, word.find('=')) != old.old_name) continue;
      word.replace(0, old.old_name.size(), old.name);
      notes.push_back(fmt::format("{} is {} now; the next version refuses the old name",
                                  old.old_name, old.name));
    }
  }
  return notes;
}

}  // namespace rholm::cli
