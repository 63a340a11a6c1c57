// Description of a command line as data. The parser, --help, the manual page and the completions
// all use this description, so that they agree. Layer: cli.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace rholm::cli {

class Session;

// The command line is wrong: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Takes the text of an option's value (`option` as typed), or throws UsageError.
using TakeText = std::function<void(const std::string& option, const std::string& text)>;
// Variable that takes the value of an option. A bool is a switch.
using Target =
    std::variant<std::monostate, bool*, int*, std::optional<int>*, double*, std::optional<double>*,
                 std::uint64_t*, std::string*, std::vector<std::string>*, TakeText>;

// Files that a shell offers for a value.
enum class Offer { kNothing, kAnyFile, kShapes, kCoefficients, kShapesAndCoefficients };

// Groups of options, in the order in which help lists them.
enum class Group { kData, kAccuracy, kOutput, kAdvanced, kPaper };
struct GroupInfo {
  Group group;
  const char* title;
  bool on_first_screen;  // false: only --help all, the manual page and the reference show it
};
inline constexpr GroupInfo kGroups[] = {{Group::kData, "Data", true},
                                        {Group::kAccuracy, "Accuracy", true},
                                        {Group::kOutput, "Output", true},
                                        {Group::kAdvanced, "Advanced", false},
                                        {Group::kPaper, "Method of the paper", false}};

struct Option {
  std::string name;        // "degree" means --degree; an operand is in capitals: "SHAPE"
  char letter = 0;         // 'o' means -o
  std::string value = {};  // placeholder in help, "L"; empty for switches and operands
  std::string help;        // one sentence without a full stop
  Target target = {};      // outlives the parser
  bool required = false;
  std::vector<std::string> choices = {};  // the only values allowed, if any
  std::optional<double> min = {};         // bounds of a number, inclusive
  std::optional<double> max = {};
  std::optional<double> above = {};  // exclusive lower bound
  // Throws UsageError for a text that is no value of `option` (as typed). Errors that can be found
  // without a file are found here, before a file is opened.
  std::function<void(const std::string& option, const std::string& text)> check = {};
  Offer offer = Offer::kNothing;
  // Returns the meaning of a text; by default the text itself.
  std::function<std::string(const std::string& text)> meaning = {};
  // Options of the library's lists begin as kAdvanced; each command moves the common ones.
  Group group = Group::kData;

  bool is_operand() const { return name.front() >= 'A' && name.front() <= 'Z'; }
  bool is_switch() const { return std::holds_alternative<bool*>(target); }
  // Returns the option as typed: "--degree", or "SHAPE".
  std::string typed() const { return is_operand() ? name : "--" + name; }
};

// Facts for batches on a command that takes one file, its first operand, and reports on it.
struct PerShape {
  std::string extension = {};  // of its default output file; empty: it writes none
  bool writes_always = true;   // true if it needs a place for that file
  std::string one_file = {};   // option that would name the same file for all shapes
};

struct Command {
  std::string name;
  std::string summary;      // one line, without a full stop
  std::string description;  // paragraphs separated by empty lines
  std::vector<Option> options;
  std::vector<std::string> examples;       // whole command lines
  std::function<int(Session&)> run = {};   // returns the exit code
  std::string if_not_star = {};            // next step for a shape that is not star-shaped
  bool hidden = false;                     // true: not in the list of commands
  std::optional<PerShape> per_shape = {};  // empty: not allowed in a batch
};

// Returns --threads and --quiet, which every command has.
struct CommonOptions;
std::vector<Option> common_options(CommonOptions& values);
// Returns the command's own and the common options of one group, in the order of the command.
// Their common targets are unused, so that the result is good for descriptions only.
std::vector<Option> described_options(const Command& command, Group group);
std::vector<Option> operands_of(const Command& command);

// Returns --json, which every command with a report has.
Option json_option(bool& json);

// Appends `more` to `list`.
void append(std::vector<Option>& list, std::vector<Option> more);

// Moves the named options to a group. Throws std::logic_error for a name that `list` lacks.
struct NamesInGroup {
  Group group;
  std::vector<std::string> names;
};
std::vector<Option> in_groups(std::vector<Option> list, const std::vector<NamesInGroup>& groups);

}  // namespace rholm::cli
