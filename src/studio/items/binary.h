// Answers that contain arrays. Layer: studio.
#pragma once

#include <string>

#include "report/view/named_arrays.h"
#include "studio/items/fields.h"
#include "studio/items/message.h"

namespace rholm::studio {

struct Binary : NamedArrays {
  Json meta = Json::object();  // further data

  std::string bytes() const { return NamedArrays::bytes(text_of(meta)); }
  Response response() const { return {.type = "application/octet-stream", .body = bytes()}; }
};

}  // namespace rholm::studio
