// Writing where the command line says. Everything that can be refused is refused before the work
// begins. Layer: cli.
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

// "-o, --output OUT", required or not, and "--format".
Option output_option(std::string& path, const std::string& help, bool required = true);
Option format_option(std::string& format, std::vector<std::string> choices);
// "--ascii".
Option ascii_option(bool& ascii, Holding holding = Holding::kAnything);
// --output, --format and --ascii of commands that write a mesh.
std::vector<Option> mesh_output_options(std::string& path, std::string& format, bool& ascii);

// What commands that change coefficients end with: where the result goes, what its numbers mean and
// those of the input, and the report.
struct CoefficientsOutputOptions {
  std::string output;
  std::string format;
  ConventionOptions convention;
  InputConvention input_convention;
  bool json = false;
};
// `what` is written; for help.
std::vector<Option> coefficients_output_options(CoefficientsOutputOptions& target,
                                                const std::string& what, bool required = true);

// What a file of coefficients is to be: a model file, or one of the library's text formats.
struct CoefficientsOutput {
  std::string path;
  std::optional<CoefficientsFormat> format;  // none: the model file
};

// The format by `format` (an option's value, may be empty), else by the extension. Throws
// UsageError if neither says it, or if "-" stands without a format. `json` is whether a report
// wants standard output too.
ShapeFormat shape_output(const std::string& path, const std::string& format, bool json = false);
// The same for a mesh: a format without faces is refused.
ShapeFormat mesh_output(const std::string& path, const std::string& format, bool json = false);
// The same for points: a format that holds triangles only is refused.
ShapeFormat points_output(const std::string& path, const std::string& format, bool json = false);
CoefficientsOutput coefficients_output(const std::string& path, const std::string& format,
                                       bool json = false);

// Throws UsageError for "-" where a name is needed, or together with --json.
void check_not_shared(const std::string& path, bool json);

// Throws UsageError for standard output, pipes and devices, where a model file (HDF5) cannot go.
void check_rewindable(const std::string& path);

// Throws Io if a file cannot be made there: no such folder, no permission. Asked before hours of
// work, the answer of the writer itself counts.
void check_writable(const std::string& path);

// write_shape(), and its warnings said.
void write_shape_output(const Mesh& mesh, const std::string& path, const ShapeWriteOptions& options,
                        Session& session);
void write_shape_output(const PointCloud& cloud, const std::string& path,
                        const ShapeWriteOptions& options, Session& session);
void warn_of_output(const std::vector<std::string>& warnings, const std::string& path,
                    Session& session);

// Says which attributes of a shape that was written there the format has no room for.
void note_attributes_left_out(std::span<const Attribute> attributes, ShapeFormat format,
                              const std::string& path, Session& session);

// Says what of the expansion the format has no room for.
void write_coefficients_output(const Expansion& expansion, const CoefficientsOutput& output,
                               const Convention& convention, Session& session);

// The file's size, if it is a file.
std::optional<std::uintmax_t> file_size_of(const std::string& path);

}  // namespace rholm::cli
