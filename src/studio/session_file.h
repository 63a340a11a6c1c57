// A session as one file. Layer: studio.
//
// "RHOLMSS1", a length (64 bits, little endian), a checksum (CRC-32) of what follows, 4 bytes 0;
// JSON of that length that describes the items; their files one after the other: PLY of meshes and
// points, model files of expansions and atlases.
#pragma once

#include <string>
#include <string_view>

#include "studio/scratch.h"
#include "studio/step.h"

namespace rholm::studio {

bool is_session_file(std::string_view bytes);  // by its first bytes

std::string session_bytes(const Document& document, Scratch& scratch);

// Adds its items, and its recipe. Throws Error{kInvalidInput} for a file that is not whole, or says
// what cannot be; no length in it is believed before it is compared with the bytes that are there.
void open_session(std::string_view bytes, Scratch& scratch, Document& document, Shared& shared,
                  const Context& context);

}  // namespace rholm::studio
