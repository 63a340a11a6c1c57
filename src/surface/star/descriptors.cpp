// Table of descriptors; each row has everything about one descriptor.
#include "rholm/descriptors.h"

namespace rholm {
namespace {

using Measures = SurfaceMeasures;

constexpr Descriptor kDescriptors[] = {
    {.name = "volume",
     .length_power = 3,
     .definition = "the volume of the solid that the surface bounds; exact for a radius",
     .source = "",
     .value = [](const Measures& of) { return of.volume; }},
    {.name = "area",
     .length_power = 2,
     .definition = "the area of the surface, to about 1e-12",
     .source = "",
     .value = [](const Measures& of) { return of.area; }},
    {.name = "sphericity",
     .length_power = 0,
     .definition =
         "the area of the ball of the same volume over the area of the surface, at most 1",
     .source = "Wadell 1935",
     .value = [](const Measures& of) { return of.sphericity(); }},
#ifdef RHOLM_EXTRA_DESCRIPTORS  // a row of tests/one_list
#include RHOLM_EXTRA_DESCRIPTORS
#endif
};

}  // namespace

std::span<const Descriptor> descriptors() { return kDescriptors; }

}  // namespace rholm
