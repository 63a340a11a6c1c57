#include "cli/grammar/old_names.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
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

std::string note_of(std::string_view old_name, std::string_view name) {
  return fmt::format("{} is {} now; the next version refuses the old name", old_name, name);
}

// Words that no version had, or an option of another command, with the next step.
struct Hint {
  std::string_view word, advice;
};
constexpr Hint kCommandHints[] = {
    {"analyse", "'rholm expand' computes coefficients"},
    {"analysis", "'rholm expand' computes coefficients"},
    {"encode", "'rholm expand' computes coefficients"},
    {"transform", "'rholm expand' computes coefficients"},
    {"decode", "'rholm synthesize' makes a mesh from coefficients"},
    {"synthesise", "'rholm synthesize' makes a mesh from coefficients"},
    {"atlas", "'rholm compress' makes an atlas of caps"},
    {"decimate", "'rholm simplify' reduces the number of faces"},
    {"mesh", "'rholm reconstruct' makes a mesh from points"},
    {"view", "'rholm render' draws a picture and 'rholm studio' opens a page"},
    {"fix", "'rholm repair' repairs a mesh"}};
constexpr Hint kOptionHints[] = {{"--atlas", "'rholm compress' makes an atlas of caps"},
                                 {"--lmax", "--degree is the highest degree"},
                                 {"--triangles", "the parts of a mesh are called faces"}};

std::string hint_of(std::span<const Hint> hints, std::string_view word) {
  for (const Hint& hint : hints) {
    if (hint.word == word) return fmt::format("; {}", hint.advice);
  }
  return {};
}

constexpr std::string_view kAnalyze = "analyze";

// Replaces "analyze", which became two commands: --atlas among its options chose the second one.
// Returns a note if the word was replaced.
std::vector<std::string> replace_analyze(std::string& word, std::vector<std::string>& options,
                                         std::size_t first) {
  if (word != kAnalyze) return {};
  const auto begin = options.begin() + static_cast<std::ptrdiff_t>(first);
  const auto atlas = std::find(begin, options.end(), "--atlas");
  if (atlas == options.end()) {
    word = "expand";
    return {note_of(kAnalyze, word)};
  }
  word = "compress";
  options.erase(atlas);
  return {note_of("analyze --atlas", word)};
}

// Replaces the old name in --command of a batch, whose options of the command follow "--".
std::vector<std::string> replace_in_batch(std::vector<std::string>& words) {
  constexpr std::string_view kOption = "--command";
  for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
    if (words[i] == kOption && i + 1 < words.size()) {
      return replace_analyze(words[i + 1], words, i + 2);
    }
    if (words[i].starts_with("--command=")) {
      std::string name = words[i].substr(kOption.size() + 1);
      auto notes = replace_analyze(name, words, i + 1);
      words[i] = fmt::format("{}={}", kOption, name);
      return notes;
    }
  }
  // Without --command the previous version took "analyze"; now it is "expand".
  std::string name(kAnalyze);
  const auto options = std::find(words.begin(), words.end(), "--");
  auto notes = replace_analyze(name, words, static_cast<std::size_t>(options - words.begin()));
  if (name == "expand") return {};
  words.insert(words.begin(), fmt::format("{}={}", kOption, name));
  return notes;
}

}  // namespace

std::vector<std::string> replace_old_command(std::vector<std::string>& words) {
  return words.empty() ? std::vector<std::string>() : replace_analyze(words.front(), words, 1);
}

std::string command_hint(std::string_view word) { return hint_of(kCommandHints, word); }
std::string option_hint(std::string_view word) { return hint_of(kOptionHints, word); }

std::vector<std::string> replace_old_names(const Command& command,
                                           std::vector<std::string>& words) {
  std::vector<std::string> notes;
  if (command.name == "batch") notes = replace_in_batch(words);
  for (std::string& word : words) {
    if (word == "--") break;  // operands follow
    for (const OldName& old : kOldNames) {
      if (command.name != old.command || word.substr(0, word.find('=')) != old.old_name) continue;
      word.replace(0, old.old_name.size(), old.name);
      notes.push_back(note_of(old.old_name, old.name));
    }
  }
  return notes;
}

}  // namespace rholm::cli
