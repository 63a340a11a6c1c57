// Stores a session in one file. Layer: studio.
//
// The file has "RHOLMSS1", a length (64 bits, little endian), a checksum (CRC-32) of what follows,
// and 4 bytes 0. Then come JSON of this length that describes the items, and their files in
// sequence: PLY of meshes and points, model files of expansions and atlases.
#pragma once

#include <string>
#include <string_view>

#include "studio/scratch.h"
#include "studio/step.h"

namespace rholm::studio {

bool is_session_file(std::string_view bytes);  // true if the first bytes match

std::string session_bytes(const Document& document, Scratch& scratch);

// Adds the items and the recipe of a file. Throws Error{kInvalidInput} for a file that is
// incomplete or inconsistent. Every length is compared with the bytes present before use.
void open_session(std::string_view bytes, Scratch& scratch, Document& document, Shared& shared,
                  const Context& context);

}  // namespace rholm::studio
