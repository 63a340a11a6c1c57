// Standard input, output and error that whoever started the program has closed. Layer: cli.
#pragma once

namespace rholm::cli {

// Opens /dev/null on those of the descriptors 0 to 2 that are closed, so that no file of the
// program gets their number. What is read from or written to them there fails, as it would on a
// closed descriptor. To be called before anything is opened.
void fill_standard_descriptors();

}  // namespace rholm::cli
