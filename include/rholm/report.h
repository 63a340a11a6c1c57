// All that is known of a model on one page. Layer: report.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/compress.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

// How to get something again: "This page", "rholm report ...".
struct ReportCommand {
  std::string what = {};     // that is got
  std::string command = {};  // to type in a shell
};

// What the page says beside its figures.
struct ReportOptions {
  std::string title = {};                    // what the page is of, as a rule a file's name
  std::string shape_name = {};               // of the shape, as a rule a file's name
  std::vector<ReportCommand> commands = {};  // shown as they are, in this order
  std::vector<std::string> notes = {};       // what must be known of the input, a sentence each
  std::optional<double> tolerance = {};  // wanted rms error of the function: a line in the plots
  double weld_tolerance = 0;             // of the shape, in its unit
  int picture_size = 480;                // pixels of each picture's side, 16 ... 4096
  std::optional<std::uint64_t> file_bytes = {};  // of an atlas: how large its file is
  // JavaScript that shows view_data() in the page, the file viewer/viewer.js of the studio's: the
  // surface of an expansion can be turned, and any degree of it looked at. Not of an atlas.
  std::string viewer = {};
};

// Their list (fields.h), without the commands.
template <typename Visitor>
void visit_fields(FieldsOf<ReportOptions>, const Visitor& field) {
  using O = ReportOptions;
  field(&O::title, {.name = "title",
                    .help = "what the page is of, as a rule a file's name",
                    .value = "TEXT",
                    .in_program = false});
  field(&O::shape_name, {.name = "shape_name",
                         .help = "name of the shape, as a rule a file's name",
                         .value = "TEXT",
                         .in_program = false});
  field(&O::notes, {.name = "notes",
                    .help = "what must be known of the input, a sentence each",
                    .in_program = false});
  field(&O::tolerance,
        {.name = "tolerance",
         .help = "wanted root mean square error of the function: a line in the plots",
         .value = "E",
         .least = 0,
         .above = true,
         .in_program = false});
  field(&O::weld_tolerance,
        {.name = "weld_tolerance",
         .help = "vertices of the shape become one whose distance is at most this",
         .value = "T",
         .least = 0,
         .unit = FieldUnit::kLength,
         .in_program = false,
         .in_python = false});
  field(&O::picture_size, {.name = "picture_size",
                           .help = "pixels of each picture's side",
                           .value = "N",
                           .least = 16,
                           .most = 4096,
                           .in_program = false});
  field(&O::file_bytes, {.name = "file_bytes",
                         .help = "of an atlas: how large its file is",
                         .in_program = false,
                         .in_python = false});
  field(&O::viewer,
        {.name = "viewer",
         .help = "JavaScript of the viewer, with which the surface of an expansion can be turned",
         .in_program = false,
         .in_python = false});
}

// A page of HTML (UTF-8) that needs no other file and runs no script but the viewer, if there is
// one: pictures of the shape and of the model at a few degrees, where they differ, the spectrum, a
// table of degrees and their errors, figures, conventions, and how to get all that again. For a
// screen of any width and for paper.
//
// `shape`: the mesh that the model is of, or nullptr if it is not at hand: then there is no picture
// of it, and of errors only what the expansion itself knows. Below 3 MB with pictures of the
// default size, and up to 7 MB more with a viewer. No degree above 512 is drawn or measured point
// by point: neither the pictures nor the patience have room for it. Same input, same bytes, for any
// number of threads. Throws InvalidInput for options out of range, an empty mesh, or coefficients
// that have no surface.
std::string report_html(const Expansion& expansion, const Mesh* shape, const ReportOptions& options,
                        const Context& context = {});

// The same of an atlas: its surface at a few limits of the degree, its caps in colours, where it
// differs from `shape`, what each degree adds, a table of limits and their errors. Surfaces are
// extracted at the model's own step; distances to and from the shape are those of 100 000 points on
// each. The tolerance of the options is not looked at: the model has its own. Throws InvalidInput
// as above, and for an atlas without caps.
std::string report_html(const AtlasModel& model, const Mesh* shape, const ReportOptions& options,
                        const Context& context = {});

// What a viewer shows of an expansion, as docs/studio.md has it: its coefficients to
// degree 512, errors of degrees, and the shape, with at most 200 000 faces; none if it cannot be
// made as simple. `shape` may be nullptr. Throws InvalidInput for coefficients that have no
// surface.
std::string view_data(const Expansion& expansion, const Mesh* shape, const std::string& title,
                      const Context& context = {});

}  // namespace rholm
