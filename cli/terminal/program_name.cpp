#include "cli/terminal/program_name.h"

namespace rholm::cli {
namespace {

std::string& name() {
  static std::string value = "rholm";
  return value;
}

}  // namespace

const std::string& program_name() { return name(); }

void set_program_name(const std::string& value) { name() = value; }

}  // namespace rholm::cli
