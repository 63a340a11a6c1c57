// The module rholm._core, a thin layer over the library. The functions that users call are in
// python/rholm.
#include <nanobind/nanobind.h>

#include "bindings.h"
#include "caller.h"
#include "rholm/rholm.h"

NB_MODULE(_core, m) {
  using namespace rholm::python;
  m.doc() = "The C++ library; use rholm itself.";
  m.attr("VERSION") = rholm::kVersion;
  m.attr("MAX_DEGREE") = rholm::kMaxDegree;
  m.attr("NO_CAP") = rholm::kNoCap;
  bind_errors(m);
  bind_caller(m);
  bind_shapes(m);
  bind_topology(m);
  bind_points(m);
  bind_coefficients(m);
  bind_harmonic(m);
  bind_motion(m);
  bind_analysis(m);
  bind_surfaces(m);
  bind_atlases(m);
  bind_reconstruction(m);
  bind_edits(m);
  bind_pictures(m);
  bind_studio(m);
  bind_batches(m);
}
