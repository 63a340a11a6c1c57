// The program rholm for tests: with the instruction set that RHOLM_TEST_TARGET names, and with
// scratch memory full of NaN. The answer to question RHOLM_TEST_INTERRUPT_AT, whether to continue,
// is no. The number of questions is written to the file RHOLM_TEST_QUESTIONS.
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "cli/program.h"
#include "cli/terminal/bus_error.h"
#include "cli/terminal/descriptors.h"
#include "cli/terminal/interrupt.h"
#include "support/targets.h"

int main(int argc, char** argv) {
  rholm::cli::fill_standard_descriptors();
  const std::string wrong = rholm::test::force_target_of_environment();
  if (!wrong.empty()) {
    std::fprintf(stderr, "%s\n", wrong.c_str());
    return 99;  // not an exit code of rholm
  }
  rholm::cli::install_signal_handlers();
  rholm::cli::install_bus_error_handler();
  if (const char* question = std::getenv("RHOLM_TEST_INTERRUPT_AT")) {
    rholm::cli::interrupt_at(std::strtoull(question, nullptr, 10));
  }
  const int code = rholm::cli::run_program({argv + 1, argv + argc});
  if (const char* file = std::getenv("RHOLM_TEST_QUESTIONS")) {
    std::ofstream(file) << rholm::cli::questions_asked();
  }
  return code;
}
