#include "cli/commands/gain_file.h"

#include <errno.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "rholm/coefficients.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

constexpr std::size_t kMaxLine = 1000;  // two numbers and a comment

struct Line {
  int degree;
  double gain;
};

// Parses a line; returns false if it has no numbers.
bool parse_line(std::string text, Line& line) {
  text.resize(std::min(text.size(), text.find('#')));
  std::istringstream words(text);
  std::string degree, gain, more;
  if (!(words >> degree)) return false;
  char *end_of_degree = nullptr, *end_of_gain = nullptr;
  words >> gain >> more;
  const long l = std::strtol(degree.c_str(), &end_of_degree, 10);
  line.gain = std::strtod(gain.c_str(), &end_of_gain);
  if (gain.empty() || !more.empty() || *end_of_degree != 0 || *end_of_gain != 0 || l < 0 ||
      l > kMaxDegree || !std::isfinite(line.gain)) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("a line must have a degree within 0 ... {} and a finite gain", kMaxDegree));
  }
  line.degree = static_cast<int>(l);
  return true;
}

}  // namespace

std::vector<double> read_gains(const std::string& path, int degree) {
  std::ifstream file(path);
  if (!file) {
    throw Error(ErrorCode::kIo, fmt::format("{} cannot be read: {}", path, std::strerror(errno)));
  }
  std::vector<double> gains(static_cast<std::size_t>(degree) + 1, 1.0);
  std::vector<bool> named(gains.size());
  std::string text(kMaxLine + 1, '\0');
  bool any = false;
  for (int number = 1; file.getline(text.data(), static_cast<std::streamsize>(text.size()));
       ++number) {
    Line line{};
    try {
      if (!parse_line(text.c_str(), line)) continue;
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}, line {}: {}", path, number, error.what()));
    }
    any = true;
    if (line.degree > degree) continue;
    if (named[line.degree]) {
      throw Error(ErrorCode::kInvalidInput, fmt::format("{}, line {}: degree {} already has a gain",
                                                        path, number, line.degree));
    }
    named[line.degree] = true;
    gains[line.degree] = line.gain;
  }
  if (file.bad()) throw Error(ErrorCode::kIo, fmt::format("{} cannot be read", path));
  if (!file.eof()) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} has a line of more than {} characters", path, kMaxLine));
  }
  if (!any)
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} contains no gain; write lines with a degree and a factor", path));
  return gains;
}

}  // namespace rholm::cli
