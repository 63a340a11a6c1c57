// Data for the viewer of web/ on a page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "report/page/report_data.h"
#include "rholm/coefficients.h"
#include "rholm/mesh.h"

namespace rholm::report {

// Most faces of the included shape, chosen: 5 MB of a page. Larger meshes are simplified.
inline constexpr std::size_t kMostFacesViewed = 200'000;

// Returns the bytes of view_data(). No degree is above kHighestDrawn.
std::string view_bytes(const Expansion& expansion, const Mesh* shape, const std::string& title,
                       const Data& data, const Context& context);

// Return a place for the viewer, and the scripts that fill it: its data,
// and the viewer itself. Neither script contains the end of its element.
std::string viewer_place();
std::string viewer_scripts(std::string_view bytes, std::string_view viewer);

}  // namespace rholm::report
