// Output files of the command line. Wrong requests are refused before the work begins.
// Layer: cli.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cli/files/formats.h"
#include "cli/grammar/command.h"
#include "cli/options/convention.h"
#include "cli/terminal/session.h"
#include "rholm/coefficients_io.h"
#include "rholm/mesh.h"
#include "rholm/shape_io.h"

namespace rholm::cli {

// Options "-o, --output OUT", required or not, and "--format".
Option output_option(std::string& path, const std::string& help, bool required = true);
Option format_option(std::string& format, std::vector<std::string> choices);
// Option "--ascii".
Option ascii_option(bool& ascii, Holding holding = Holding::kAnything);
// Returns --output, --format and --ascii for commands that write a mesh.
std::vector<Option> mesh_output_options(std::string& path, std::string& format, bool& ascii);

// Common options of commands that change coefficients: output, conventions of the output and the
// input, and report.
struct CoefficientsOutputOptions {
  std::string output;
  std::string format;
  ConventionOptions convention;
  InputConvention input_convention;
  bool json = false;
};
// Returns the options; `what` names the output in the help.
std::vector<Option> coefficients_output_options(CoefficientsOutputOptions& target,
                                                const std::string& what, bool required = true);

// Output of coefficients: a model file, or one of the library's text formats.
struct CoefficientsOutput {
  std::string path;
  std::optional<CoefficientsFormat> format;  // empty: the model file
};

// Returns the format: `format` (an option's value, may be empty), otherwise from the extension.
// Throws UsageError if neither gives one, or for "-" without a format. `json` is true if a report
// uses standard output as well.
ShapeFormat shape_output(const std::string& path, const std::string& format, bool json = false);
// Returns the format of a mesh: a format without faces is refused.
ShapeFormat mesh_output(const std::string& path, const std::string& format, bool json = false);
// Returns the format of points: a format that holds only faces is refused.
ShapeFormat points_output(const std::string& path, const std::string& format, bool json = false);
CoefficientsOutput coefficients_output(const std::string& path, const std::string& format,
                                       bool json = false);

// Throws UsageError for "-" where a file name is needed, or together with --json.
void check_not_shared(const std::string& path, bool json);

// Throws UsageError for standard output, pipes and devices, which cannot hold a model file (HDF5).
void check_rewindable(const std::string& path);

// Throws Io if a file cannot be created: missing folder, no permission. Called before hours of
// work; the writer checks again.
void check_writable(const std::string& path);

// Call write_shape(), and report its warnings.
void write_shape_output(const Mesh& mesh, const std::string& path, const ShapeWriteOptions& options,
                        Session& session);
void write_shape_output(const PointCloud& cloud, const std::string& path,
                        const ShapeWriteOptions& options, Session& session);
void warn_of_output(const std::vector<std::string>& warnings, const std::string& path,
                    Session& session);

// Notes which attributes of a written shape the format has no room for.
void note_attributes_left_out(std::span<const Attribute> attributes, ShapeFormat format,
                              const std::string& path, Session& session);

// Writes coefficients, and notes which metadata the format has no room for.
void write_coefficients_output(const Expansion& expansion, const CoefficientsOutput& output,
                               const Convention& convention, Session& session);

// Returns the size of a regular file.
std::optional<std::uintmax_t> file_size_of(const std::string& path);

}  // namespace rholm::cli
