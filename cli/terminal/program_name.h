// Name of the program in all messages. Layer: cli.
#pragma once

#include <string>

namespace rholm::cli {

// Returns "rholm", unless set_program_name() set another name, before threads start.
const std::string& program_name();
void set_program_name(const std::string& value);

}  // namespace rholm::cli
