// Reading what the command line names: shapes, coefficients, either. Layer: cli.
//
// A regular file is read by the library; standard input ("-") and pipes are read here, once, so
// that their content can be looked at and Ctrl-C ends the wait.
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

// MODEL and MESH, files or standard input.
Option model_operand(std::string& path);
Option mesh_operand(std::string& path);

// "--columns LIST": what the columns of a text table of points are.
Option columns_option(std::string& columns);

using Input = std::variant<ShapeFile, CoefficientsFile>;

// Each throws what the readers throw; the wrong kind of file is InvalidInput, and the message
// names the command that makes the right one. What a file of coefficients does not say, and was
// assumed, is said, and if it is of no surface. `columns` is as in ShapeReadOptions.
ShapeFile read_shape_input(const std::string& path, Session& session,
                           const std::string& columns = {});
CoefficientsFile read_coefficients_input(const std::string& path, Session& session,
                                         const InputConvention& convention);
Input read_input(const std::string& path, Session& session, const InputConvention& convention,
                 const std::string& columns = {});

// The same where a surface is needed: coefficients of something else are Unsupported.
Expansion read_expansion(const std::string& path, Session& session,
                         const InputConvention& convention);
Input read_surface_input(const std::string& path, Session& session,
                         const InputConvention& convention, const std::string& columns = {});

// Whether the beginning of a file, or its name, says that it is a shape; none: neither says.
std::optional<bool> is_shape(const std::string& path);
// As read_input() of bytes that came from there.
Input read_input_of(std::vector<char> bytes, const std::string& path, Session& session,
                    const InputConvention& convention, const std::string& columns = {});

// Says what the columns of a table were taken for, and the warnings of its reader.
void say_what_was_read(const TableColumns& table, const std::vector<std::string>& warnings,
                       const std::string& path, Session& session);
void say_what_was_read(const ShapeFile& file, const std::string& path, Session& session);

// Whether a file holds an atlas; streams and what cannot be read do not.
bool holds_atlas(const std::string& path);

// The mesh of a file, its warnings passed on; points are refused.
Mesh mesh_of(ShapeFile file, const std::string& path, Session& session);
Mesh read_mesh(const std::string& path, Session& session);

// As read_shape_input() and read_mesh() of bytes that came from there.
ShapeFile read_shape_of(std::span<const char> bytes, const std::string& path, Session& session,
                        const std::string& columns = {});
Mesh read_mesh_of(std::span<const char> bytes, const std::string& path, Session& session);

// All bytes of a file or of standard input. Throws Io, Cancelled.
std::vector<char> read_all_bytes(const std::string& path);

}  // namespace rholm::cli
