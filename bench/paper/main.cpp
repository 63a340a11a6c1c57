// Runs the paper's experiments. The script `run` beside this file calls it and writes the document.
//
// Usage: paper_experiments OUTPUT [--data DIR] [--quick] [--only table|plot|levels]
//
// Figures go to OUTPUT/results.json, pictures to OUTPUT; the folder is made if it does not exist.
#include <cstring>
#include <exception>
#include <fstream>
#include <string>

#include "experiments.h"

namespace rholm::paper {
namespace {

struct Arguments {
  Settings settings;
  std::string only;
  bool valid = false;
};

Arguments parse(int count, char** words) {
  Arguments result;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const bool has_value = i + 1 < count;
    if (word == "--quick") {
      result.settings.quick = true;
    } else if (word == "--data" && has_value) {
      result.settings.data.folder = words[++i];
    } else if (word == "--only" && has_value) {
      result.only = words[++i];
    } else if (result.settings.images.empty() && word[0] != '-') {
      result.settings.images = word;
    } else {
      return result;
    }
  }
  result.valid = !result.settings.images.empty();
  return result;
}

void run(const Arguments& arguments) {
  const Settings& settings = arguments.settings;
  std::filesystem::create_directories(settings.images);
  const auto wanted = [&](const char* name) {
    return arguments.only.empty() || arguments.only == name;
  };
  Json results = {{"compiler", __VERSION__}, {"quick", settings.quick}};
  if (wanted("levels")) results["levels"] = levels_of_detail(settings);
  if (wanted("plot")) results["figure_four"] = figure_four(settings);
  if (wanted("table")) results["table_one"] = table_one(settings);
  std::ofstream file(settings.images / "results.json");
  file << results.dump(1) << '\n';
  if (!file.flush()) throw std::runtime_error("results.json cannot be written");
}

}  // namespace
}  // namespace rholm::paper

int main(int count, char** words) {
  const rholm::paper::Arguments arguments = rholm::paper::parse(count, words);
  if (!arguments.valid) {
    std::fprintf(stderr,
                 "usage: paper_experiments OUTPUT [--data DIR] [--quick] "
                 "[--only table|plot|levels]\n");
    return 2;
  }
  try {
    rholm::paper::run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "paper_experiments: %s\n", error.what());
    return 1;
  }
}
