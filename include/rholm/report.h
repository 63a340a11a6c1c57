// A report of a model on one HTML page. Layer: report.
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

// A command that makes something again: "This page", "rholm report ...".
struct ReportCommand {
  std::string what = {};     // result of the command
  std::string command = {};  // text to type in a shell
};

// Texts of the page, and settings of its figures.
struct ReportOptions {
  std::string title = {};                    // title of the page, usually a file's name
  std::string shape_name = {};               // name of the shape, usually a file's name
  std::vector<ReportCommand> commands = {};  // shown unchanged, in this order
  std::vector<std::string> notes = {};       // facts on the input, a sentence each
  std::optional<double> tolerance = {};  // wanted rms error of the function: a line in the plots
  double weld_tolerance = 0;             // tolerance for welding the shape, in its unit
  int picture_size = 480;                // side of each picture in pixels, 16 ... 4096
  std::optional<std::uint64_t> file_bytes = {};  // size of an atlas's file
  // JavaScript that shows view_data() in the page: the file viewer/viewer.js of the studio. It lets
  // readers turn the surface of an expansion and choose its degree. An atlas does not use it.
  std::string viewer = {};
};

// Lists the fields of ReportOptions (fields.h), without the commands.
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

// Returns a page of HTML (UTF-8) that needs no other file and no script except the viewer. Its
// pictures show the shape, the model at several degrees, and their difference. It has the spectrum,
// a table of degrees and errors, further numbers, conventions, and commands. It suits screens of
// any width and paper.
//
// `shape` is the mesh of the model, or nullptr: then its picture is missing,
// and errors are those stored in the expansion. The page is below 3 MB with
// pictures of the default size, and up to 7 MB more with a viewer. Degrees
// above 512 are neither drawn nor measured point by point: chosen, for size and
// time. Same input, same bytes, for any number of threads. Throws InvalidInput
// for options out of range, an empty mesh, or coefficients without a surface.
std::string report_html(const Expansion& expansion, const Mesh* shape, const ReportOptions& options,
                        const Context& context = {});

// Returns the page of an atlas. It shows surfaces at several limits of the degree, the caps in
// colours, the difference to `shape`, and the effect of each degree. A table lists limits and
// errors. Surfaces use the model's own step; distances are measured at 100 000 points of each
// surface. The tolerance of the options is ignored, because the model has its own. Throws
// InvalidInput as above, and for an atlas without caps.
std::string report_html(const AtlasModel& model, const Mesh* shape, const ReportOptions& options,
                        const Context& context = {});

// Returns the data of the viewer (docs/studio.md): coefficients to degree 512, errors of
// degrees, and the shape with at most 200 000 faces. A shape that cannot be simplified to that
// number is left out. `shape` may be nullptr. Throws InvalidInput for coefficients without a
// surface.
std::string view_data(const Expansion& expansion, const Mesh* shape, const std::string& title,
                      const Context& context = {});

}  // namespace rholm
