// The program rholm. Layer: cli.
#include "cli/interrupt.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  rholm::cli::install_signal_handlers();
  return rholm::cli::run_program({argv + 1, argv + argc});
}
