// What a check of a header says, and to whom.
#pragma once

#include <string>
#include <vector>

// A public header by its file name, and a function that uses something of it; throws
// std::runtime_error where the result is not the known one.
struct HeaderCheck {
  std::string header;
  void (*run)();
};

// One list for each group of headers.
std::vector<HeaderCheck> base_checks();
std::vector<HeaderCheck> harmonic_checks();
std::vector<HeaderCheck> shape_checks();
std::vector<HeaderCheck> file_checks();
std::vector<HeaderCheck> star_checks();
std::vector<HeaderCheck> surface_checks();
std::vector<HeaderCheck> edit_checks();
std::vector<HeaderCheck> model_checks();
std::vector<HeaderCheck> report_checks();

// Throws with the claim unless it holds.
void expect(bool holds, const std::string& claim);
// Throws with the name and both numbers unless |value - expected| <= tolerance.
void expect_near(double value, double expected, double tolerance, const std::string& name);
