// What a command line may hold, as data. The parser, --help, the manual page and the completions
// are all made from this one description, so that they cannot disagree. Layer: cli.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace rholm::cli {

class Session;

// The command line does not mean anything: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Takes the text of an option's value (`option` as typed), or throws UsageError.
using TakeText = std::function<void(const std::string& option, const std::string& text)>;
// Where the value of an option goes. A bool is a switch.
using Target =
    std::variant<std::monostate, bool*, int*, std::optional<int>*, double*, std::optional<double>*,
                 std::uint64_t*, std::string*, std::vector<std::string>*, TakeText>;

// What a shell offers for a value.
enum class Offer { kNothing, kAnyFile, kShapes, kCoefficients, kShapesAndCoefficients };

struct Option {
  std::string name;        // "degree" means --degree; an operand is in capitals: "SHAPE"
  char letter = 0;         // 'o' means -o
  std::string value = {};  // how help calls the value, "L"; empty for switches and operands
  std::string help;        // one sentence without a full stop
  Target target = {};      // outlives the parser
  bool required = false;
  std::vector<std::string> choices = {};  // the only values allowed, if any
  std::optional<double> min = {};         // bounds of a number, inclusive
  std::optional<double> max = {};
  std::optional<double> above = {};  // a lower bound that is not allowed itself
  // Throws UsageError for a text that is no value of `option` (as typed). Whatever can be known
  // to be wrong without a file is refused here, before one is opened.
  std::function<void(const std::string& option, const std::string& text)> check = {};
  Offer offer = Offer::kNothing;
  // What a text stands for; by default itself.
  std::function<std::string(const std::string& text)> meaning = {};

  bool is_operand() const { return name.front() >= 'A' && name.front() <= 'Z'; }
  bool is_switch() const { return std::holds_alternative<bool*>(target); }
  // As it is typed: "--degree", or "SHAPE".
  std::string typed() const { return is_operand() ? name : "--" + name; }
};

// What a batch has to know of a command that takes one file, its first operand, and reports on it.
struct PerShape {
  std::string extension = {};  // of the file it writes by default; empty: it writes none
  bool writes_always = true;   // whether it needs a place for that file
  std::string one_file = {};   // an option that would name the same file for all shapes
};

struct Command {
  std::string name;
  std::string summary;      // one line, without a full stop
  std::string description;  // paragraphs separated by empty lines
  std::vector<Option> options;
  std::vector<std::string> examples;       // whole command lines
  std::function<int(Session&)> run = {};   // returns the exit code
  std::string if_not_star = {};            // what to do with a shape that is not star-shaped
  bool hidden = false;                     // not in the list of commands
  std::optional<PerShape> per_shape = {};  // none: not for a batch
};

// --threads and --quiet, which every command has.
struct CommonOptions;
std::vector<Option> common_options(CommonOptions& values);

// --json, which every command that reports has.
Option json_option(bool& json);

// `more` behind `list`.
void append(std::vector<Option>& list, std::vector<Option> more);

}  // namespace rholm::cli
