#include "studio/recipe.h"

#include <cctype>
#include <filesystem>

#include <fmt/format.h>

namespace rholm::studio {
namespace {

constexpr std::size_t kMostLetters = 100;  // letters of a variable; chosen: files have them, too

bool is_whole(const Item& item) { return item.look == whole(*item.model); }

}  // namespace

Json json_of(const Named& named) { return {{"file", named.file}, {"variable", named.variable}}; }

std::string Recipe::file(const std::string& stem, const std::string& ending) {
  std::string name = stem + ending;
  for (int n = 2; !files.insert(name).second; ++n) name = fmt::format("{}-{}{}", stem, n, ending);
  return name;
}

std::string Recipe::variable(const std::string& stem) {
  std::string plain;
  for (const char c : stem) {
    const auto byte = static_cast<unsigned char>(c);
    plain += byte < 128 && std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : '_';
  }
  if (plain.empty() || std::isdigit(static_cast<unsigned char>(plain[0])) != 0)
    plain = "s_" + plain;
  plain = free_variable(plain.substr(0, kMostLetters));
  std::string name = plain;
  for (int n = 2; !variables.insert(name).second; ++n) name = fmt::format("{}_{}", plain, n);
  return name;
}

void Recipe::add(const Json& step) {
  StepLines lines = step_lines(step, *this);
  steps.push_back(step);
  for (std::string& line : lines.shell) shell.push_back(std::move(line));
  for (std::string& line : lines.python) python.push_back(std::move(line));
  for (Named& made : lines.made) {
    if (!made.file.empty()) files.insert(std::move(made.file));
    if (!made.variable.empty()) variables.insert(std::move(made.variable));
  }
}

bool Recipe::has_variable(const std::string& expression) const {
  constexpr std::string_view kSurface = ".mesh()";
  return variables.contains(expression) ||
         (expression.ends_with(kSurface) &&
          variables.contains(expression.substr(0, expression.size() - kSurface.size())));
}

std::string digits(double value) { return fmt::format("{}", value); }

std::string stem_of(const std::string& name) {
  const std::string stem = std::filesystem::path(name).stem().string();
  return stem.empty() ? "shape" : stem;
}

Named model_of(Recipe& recipe, const Item& item) {
  Named model = {item.model_file, item.model_variable};
  if (is_whole(item)) return model;
  const std::string stem = stem_of(item.name);
  const Named made = {recipe.file(stem + "-filtered", ".h5"), recipe.variable(stem + "_filtered")};
  Json step = {{"op", "filter"}, {"from", json_of(model)}, {"made", json_of(made)}};
  if (item.look.gains.empty()) {
    step["degree"] = item.look.degree;
  } else {
    step["gains"] = item.look.gains;
    step["degrees"] = item.model->power.size();
    step["gain_file"] = recipe.file(stem + "-gains", ".txt");
  }
  recipe.add(step);
  return made;
}

Named surface_of(Recipe& recipe, const Item& item) {
  if (!item.model) return {item.file, item.variable};
  const bool cut = item.look.gains.empty();
  const Named model = cut ? Named{item.model_file, item.model_variable} : model_of(recipe, item);
  const std::string stem = stem_of(item.name);
  const Named made = {recipe.file(stem + "-surface", ".ply"), recipe.variable(stem + "_surface")};
  Json step = {{"op", "synthesize"}, {"from", json_of(model)}, {"made", json_of(made)}};
  if (cut && !is_whole(item)) step["degree"] = item.look.degree;
  if (item.model->original) step["like"] = json_of(Named{item.file, item.variable});
  recipe.add(step);
  return made;
}

Recipe with_looks(Recipe recipe, std::span<const ItemPtr> items) {
  for (const ItemPtr& item : items) {
    if (item->model && !is_whole(*item)) surface_of(recipe, *item);
  }
  return recipe;
}

void add_reading(Recipe& recipe, Item& item) {
  const bool series = item.model != nullptr || item.atlas != nullptr;
  const Named made = {item.name, recipe.variable(stem_of(item.name))};
  (series ? item.model_file : item.file) = made.file;
  (series ? item.model_variable : item.variable) = made.variable;
  if (item.atlas) {  // an atlas surface has a file only when needed
    item.file = item.name;
    item.variable = made.variable + ".mesh()";
  }
  recipe.add({{"op", "read"}, {"made", json_of(made)}, {"series", series}});
  if (!item.table) return;
  auto table = std::make_shared<Table>(*item.table);
  table->file = made.file;
  table->variable = made.variable;
  item.table = std::move(table);
}

}  // namespace rholm::studio
