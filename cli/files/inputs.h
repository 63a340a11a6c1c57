// Reading of inputs on the command line: shapes, coefficients, or either. Layer: cli.
//
// The library reads regular files. Standard input ("-") and pipes are read here, once: their
// content can be inspected, and Ctrl-C ends the wait.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/options/convention.h"
#include "cli/terminal/session.h"
#include "rholm/coefficients_io.h"
#include "rholm/mesh.h"
#include "rholm/shape_io.h"

namespace rholm::cli {

// Operands MODEL and MESH: files or standard input.
Option model_operand(std::string& path);
Option mesh_operand(std::string& path);

// Option "--columns LIST": meaning of the columns of a text table of points.
Option columns_option(std::string& columns);

using Input = std::variant<ShapeFile, CoefficientsFile>;

// Read an input. Throw as the readers; a wrong kind of file is InvalidInput, and the message names
// the command for the right kind. Notes tell conventions that were assumed, and coefficients
// without a surface. `columns` is as in ShapeReadOptions.
ShapeFile read_shape_input(const std::string& path, Session& session,
                           const std::string& columns = {});
CoefficientsFile read_coefficients_input(const std::string& path, Session& session,
                                         const InputConvention& convention);
Input read_input(const std::string& path, Session& session, const InputConvention& convention,
                 const std::string& columns = {});

// Read an input that must be a surface: coefficients of anything else are Unsupported.
Expansion read_expansion(const std::string& path, Session& session,
                         const InputConvention& convention);
Input read_surface_input(const std::string& path, Session& session,
                         const InputConvention& convention, const std::string& columns = {});

// Returns true if the beginning or name of a file is a shape's, nothing if neither tells.
std::optional<bool> is_shape(const std::string& path);
// Does as read_input() for bytes read from that path.
Input read_input_of(std::vector<char> bytes, const std::string& path, Session& session,
                    const InputConvention& convention, const std::string& columns = {});

// Notes the meaning of the columns of a table, and the warnings of its reader.
void say_what_was_read(const TableColumns& table, const std::vector<std::string>& warnings,
                       const std::string& path, Session& session);
void say_what_was_read(const ShapeFile& file, const std::string& path, Session& session);

// Returns true if a file holds an atlas; false for streams and unreadable files.
bool holds_atlas(const std::string& path);

// Return the mesh of a file, and pass on its warnings; points are refused.
Mesh mesh_of(ShapeFile file, const std::string& path, Session& session);
Mesh read_mesh(const std::string& path, Session& session);

// Do as read_shape_input() and read_mesh() for bytes read from that path.
ShapeFile read_shape_of(std::span<const char> bytes, const std::string& path, Session& session,
                        const std::string& columns = {});
Mesh read_mesh_of(std::span<const char> bytes, const std::string& path, Session& session);

// Returns all bytes of a file or of standard input. Throws Io, Cancelled.
std::vector<char> read_all_bytes(const std::string& path);

}  // namespace rholm::cli
