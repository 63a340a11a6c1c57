// Known word nearest to a misspelt one. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rholm::cli {

// Returns "; did you mean 'analyze'?" with the known word that is nearest to `word`. A word is near
// if it begins with `word`, or if one letter in three differs. Empty if no word is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace rholm::cli
