// What the program is called, in all that it says. Layer: cli.
#pragma once

#include <string>

namespace rholm::cli {

// "rholm", unless set_program_name() gave another one, before there are threads.
const std::string& program_name();
void set_program_name(const std::string& value);

}  // namespace rholm::cli
