// Shortens a mapped input during reading: maps the PLY file `input`, begins to write `output`,
// truncates `input` itself, and reads on. Ends as the program rholm does.
#include <unistd.h>

#include <cstdio>

#include "cli/terminal/bus_error.h"
#include "io/file/atomic_file.h"
#include "rholm/mapped_mesh.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  rholm::cli::install_bus_error_handler();
  const auto mesh = rholm::map_mesh(argv[1]);
  if (!mesh) return 2;
  rholm::AtomicFile output(argv[2]);
  output.write({"unfinished", 10});
  if (::truncate(argv[1], 100) != 0) return 2;
  const rholm::Triangle last = mesh->view().triangle(mesh->view().n_faces - 1);
  std::printf("still there: %u\n", last[0]);
  return 0;
}
