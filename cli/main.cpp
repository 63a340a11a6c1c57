// The program rholm. Layer: cli.
#include "cli/program.h"
#include "cli/terminal/bus_error.h"
#include "cli/terminal/descriptors.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/interrupt.h"

int main(int argc, char** argv) {
  rholm::cli::fill_standard_descriptors();
  rholm::cli::keep_freed_memory();
  rholm::cli::start_on_huge_pages();
  rholm::cli::install_signal_handlers();
  rholm::cli::install_bus_error_handler();
  return rholm::cli::run_program({argv + 1, argv + argc});
}
