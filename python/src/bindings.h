// Parts of the module, one source file each. Layer: python.
#pragma once

#include <nanobind/nanobind.h>

namespace rholm::python {

void bind_errors(nanobind::module_& m);
void bind_shapes(nanobind::module_& m);        // meshes, points, their files
void bind_topology(nanobind::module_& m);      // edges, welding, inspection, repair
void bind_points(nanobind::module_& m);        // sampling, normals
void bind_coefficients(nanobind::module_& m);  // conventions, filters, files
void bind_harmonic(nanobind::module_& m);      // sums, grids
void bind_motion(nanobind::module_& m);        // rotations, alignment, centres
void bind_analysis(nanobind::module_& m);      // from a mesh to an expansion
void bind_surfaces(nanobind::module_& m);      // from an expansion to a mesh, distances
void bind_atlases(nanobind::module_& m);       // compression, the paper's atlas
void bind_reconstruction(nanobind::module_& m);
void bind_edits(nanobind::module_& m);     // smoothing, transfer
void bind_batches(nanobind::module_& m);   // tables of many shapes
void bind_pictures(nanobind::module_& m);  // pictures, reports
void bind_studio(nanobind::module_& m);    // requests of notebook pages

}  // namespace rholm::python
