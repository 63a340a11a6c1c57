// The paper's experiments: each returns its figures as JSON and writes its pictures.
#pragma once

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include <nlohmann/json.hpp>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "shapes.h"

namespace rholm::paper {

using Json = nlohmann::json;

struct Settings {
  Data data;
  bool quick = false;            // small generated bodies and low degrees
  std::filesystem::path images;  // folder of pictures
};

inline const Context kOneThread = {.threads = 1, .progress = {}};

// Returns the error of coefficients: the root mean square over directions of the difference of the
// two radii, divided by the mean radius.
inline double radius_error(const Coefficients& found, const Coefficients& exact) {
  double sum = 0;
  for (std::size_t i = 0; i < exact.values().size(); ++i) {
    sum += std::pow(found.values()[i] - exact.values()[i], 2);
  }
  return std::sqrt(sum) / std::abs(exact.c(0, 0));
}

Json table_one(const Settings& settings);
Json figure_four(const Settings& settings);
Json levels_of_detail(const Settings& settings);

}  // namespace rholm::paper
