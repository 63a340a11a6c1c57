// What is asked of one item and of filter windows, answered. Layer: studio.
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

// BINARY of positions, normals, triangles, colours, labels of caps, faces that the centre does not
// see; without its look if the original is wanted.
Response surface_answer(const Item& item, bool original);
// Energy and errors of every degree.
Response measures_answer(const Item& item);
// A file of the format "ply", "h5", "png", ..., with the bytes that the program writes; of the size
// "WxH" if it is a picture. Throws Refusal 400 for a format that the item has not.
Response save_answer(const Item& item, const Recipe& recipe, const std::string& format,
                     const std::string& size, Scratch& scratch, const Context& context);

// All windows of filters, as the table of the library has them, and which is the default.
Response windows_answer();
// The gains of a low-pass filter for the degrees 0 ... `degree`: `query` names the `window`, its
// `cutoff`, `degree`, and any of its parameters. Throws Refusal 400 for what is no number, and what
// low_pass() throws.
Response gains_answer(const std::map<std::string, std::string>& query);

}  // namespace rholm::studio
