// Checks of public headers, and functions that report their failures.
#pragma once

#include <string>
#include <vector>

// A public header by its file name, and a function that uses a part of it. The function throws
// std::runtime_error where the result is not the known one.
struct HeaderCheck {
  std::string header;
  void (*run)();
};

// Each group of headers has its own list.
std::vector<HeaderCheck> base_checks();
std::vector<HeaderCheck> harmonic_checks();
std::vector<HeaderCheck> shape_checks();
std::vector<HeaderCheck> file_checks();
std::vector<HeaderCheck> star_checks();
std::vector<HeaderCheck> surface_checks();
std::vector<HeaderCheck> edit_checks();
std::vector<HeaderCheck> model_checks();
std::vector<HeaderCheck> report_checks();

// Throws an error with the text of the claim if it does not hold.
void expect(bool holds, const std::string& claim);
// Throws an error with the name and both numbers if |value - expected| > tolerance.
void expect_near(double value, double expected, double tolerance, const std::string& name);
