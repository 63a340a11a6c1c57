// Answers requests about one item and about filter windows. Layer: studio.
#pragma once

#include <map>
#include <string>

#include "studio/items/fields.h"
#include "studio/items/item.h"
#include "studio/items/message.h"
#include "studio/recipe.h"
#include "studio/scratch.h"

namespace rholm::studio {

Response json_response(const Json& json, int status = 200);

// Returns BINARY of positions, normals, triangles, colours, labels of caps, and faces
// that the centre does not see. With `original`, the surface is shown without its look.
Response surface_answer(const Item& item, bool original);
// Returns the energy and the errors of every degree.
Response measures_answer(const Item& item);
// Returns a file of the format "ply", "h5", "png", ..., with the bytes that the program writes.
// `size` is "WxH" for pictures. Throws Refusal 400 if the item cannot be saved in that format.
Response save_answer(const Item& item, const Recipe& recipe, const std::string& format,
                     const std::string& size, Scratch& scratch, const Context& context);

// Returns all filter windows in the library's table, and the default.
Response windows_answer();
// Returns the gains of a low-pass filter for the degrees 0 ... `degree`.
// `query` has the `window`, `cutoff`, `degree` and parameters of the window.
// Throws Refusal 400 for invalid numbers, and the errors of low_pass().
Response gains_answer(const std::map<std::string, std::string>& query);

}  // namespace rholm::studio
