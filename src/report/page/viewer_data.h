// What the viewer of web/ shows on a page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "report/page/report_data.h"
#include "rholm/coefficients.h"
#include "rholm/mesh.h"

namespace rholm::report {

// Faces of the shape that goes along, at most, chosen: 5 MB of a page. Of more a simpler one does.
inline constexpr std::size_t kMostFacesViewed = 200'000;

// The bytes of view_data(). No degree above kHighestDrawn.
std::string view_bytes(const Expansion& expansion, const Mesh* shape, const std::string& title,
                       const Data& data, const Context& context);

// A place for the viewer; what makes it one: its data, and the viewer itself, none of which ends
// the element that it stands in.
std::string viewer_place();
std::string viewer_scripts(std::string_view bytes, std::string_view viewer);

}  // namespace rholm::report
