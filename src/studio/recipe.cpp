#include "studio/recipe.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rholm::studio {
namespace {

bool is_plain(unsigned char c) {
  return std::isalnum(c) != 0 ||
         std::string_view("_-./:,+=@%").find(static_cast<char>(c)) != std::string_view::npos;
}

bool is_whole(const Item& item) { return item.look == whole(*item.model); }

std::vector<std::string> texts_of(const std::vector<double>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(digits(value));
  return texts;
}

// A file with a degree and its gain a line, of all degrees.
std::string gain_file(Recipe& recipe, const Item& item) {
  const std::string name = recipe.file(stem_of(item.name) + "-gains", ".txt");
  std::vector<double> gains = item.look.gains;
  gains.resize(item.model->power.size());
  std::string pairs;
  for (std::size_t l = 0; l < gains.size(); ++l) pairs += fmt::format(" {} {}", l, gains[l]);
  recipe.shell.push_back(fmt::format("printf '%d %s\\n'{} > {}", pairs, shell_word(name)));
  return name;
}

}  // namespace

std::string Recipe::file(const std::string& stem, const std::string& ending) {
  std::string name = stem + ending;
  for (int n = 2; !files.insert(name).second; ++n) name = fmt::format("{}-{}{}", stem, n, ending);
  return name;
}

std::string Recipe::variable(const std::string& stem) {
  static const std::set<std::string> kReserved = {
      "rholm", "and",    "as",   "assert", "async",  "await",    "break", "class", "continue",
      "def",   "del",    "elif", "else",   "except", "finally",  "for",   "from",  "global",
      "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",   "or",    "pass",
      "raise", "return", "try",  "while",  "with",   "yield",    "False", "None",  "True"};
  std::string plain;
  for (const char c : stem) {
    const auto byte = static_cast<unsigned char>(c);
    plain += byte < 128 && std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : '_';
  }
  if (plain.empty() || std::isdigit(static_cast<unsigned char>(plain[0])) != 0)
    plain = "s_" + plain;
  if (kReserved.contains(plain)) plain += '_';
  std::string name = plain;
  for (int n = 2; !variables.insert(name).second; ++n) name = fmt::format("{}_{}", plain, n);
  return name;
}

std::string shell_word(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) {
    return word.front() == '-' ? "./" + word : word;
  }
  std::string text = word.starts_with('-') ? "'./" : "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string python_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string python_list(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  quoted.reserve(texts.size());
  for (const std::string& text : texts) quoted.push_back(python_text(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string digits(double value) { return fmt::format("{}", value); }

std::string stem_of(const std::string& name) {
  const std::string stem = std::filesystem::path(name).stem().string();
  return stem.empty() ? "shape" : stem;
}

Named model_of(Recipe& recipe, const Item& item) {
  if (is_whole(item)) return {item.model_file, item.model_variable};
  const Named made = {recipe.file(stem_of(item.name) + "-filtered", ".h5"),
                      recipe.variable(stem_of(item.name) + "_filtered")};
  std::string options = item.look.gains.empty()
                            ? fmt::format("--low-pass {} --window ideal", item.look.degree)
                            : "--gain " + shell_word(gain_file(recipe, item));
  recipe.shell.push_back(fmt::format("rholm filter {} {} -o {}", shell_word(item.model_file),
                                     options, shell_word(made.file)));
  recipe.python.push_back(item.look.gains.empty()
                              ? fmt::format("{} = {}.low_pass({}, window=\"ideal\")", made.variable,
                                            item.model_variable, item.look.degree)
                              : fmt::format("{} = {}.filter([{}])", made.variable,
                                            item.model_variable,
                                            fmt::join(texts_of(item.look.gains), ", ")));
  return made;
}

Named surface_of(Recipe& recipe, const Item& item) {
  if (!item.model) return {item.file, item.variable};
  const bool cut = item.look.gains.empty();
  const Named model = cut ? Named{item.model_file, item.model_variable} : model_of(recipe, item);
  const Named made = {recipe.file(stem_of(item.name) + "-surface", ".ply"),
                      recipe.variable(stem_of(item.name) + "_surface")};
  std::string shell = "rholm synthesize " + shell_word(model.file);
  std::vector<std::string> python;
  if (cut && !is_whole(item)) {
    shell += fmt::format(" --degree {}", item.look.degree);
    python.push_back(fmt::format("degree={}", item.look.degree));
  }
  if (item.model->original) {
    shell += " --like " + shell_word(item.file);
    python.push_back("like=" + item.variable);
  }
  recipe.shell.push_back(shell + " -o " + shell_word(made.file));
  recipe.python.push_back(
      fmt::format("{} = {}.mesh({})", made.variable, model.variable, fmt::join(python, ", ")));
  return made;
}

Recipe with_looks(Recipe recipe, std::span<const ItemPtr> items) {
  for (const ItemPtr& item : items) {
    if (item->model && !is_whole(*item)) surface_of(recipe, *item);
  }
  return recipe;
}

void add_reading(Recipe& recipe, Item& item) {
  recipe.files.insert(item.name);
  const std::string variable = recipe.variable(stem_of(item.name));
  const bool series = item.model != nullptr || item.atlas != nullptr;
  (series ? item.model_file : item.file) = item.name;
  (series ? item.model_variable : item.variable) = variable;
  if (item.atlas) {  // whose surface has a file only when it is wanted
    item.file = item.name;
    item.variable = variable + ".mesh()";
  }
  recipe.python.push_back(
      series ? fmt::format("{} = rholm.load({})", variable, python_text(item.name))
             : fmt::format("{} = rholm.read_shape({}).shape", variable, python_text(item.name)));
}

}  // namespace rholm::studio
