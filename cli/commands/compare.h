// rholm compare with an exchangeable measurement. Layer: cli.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "cli/grammar/command.h"
#include "rholm/compare.h"
#include "rholm/context.h"

namespace rholm::cli {

struct CompareBy {
  // Called before the two files are read.
  std::function<void(const std::string& a, const std::string& b)> begin;
  // Type of compare() in rholm/compare.h; returns nothing if another process reports.
  std::function<std::optional<Comparison>(const Mesh& a, const Mesh& b,
                                          const CompareOptions& options, const Context& context)>
      compare;
  // Type of compare() for meshes that need not fit in memory; empty: meshes are read.
  std::function<Comparison(const MeshInPlace& a, const MeshInPlace& b, std::size_t memory,
                           const CompareOptions& options, const Context& context)>
      compare_in_place = {};
};
Command compare_command_by(const CompareBy& by);

}  // namespace rholm::cli
