// What is asked of one item, answered. Layer: studio.
#pragma once

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

}  // namespace rholm::studio
