// Completions for shells, made from the descriptions of the commands. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Return the completion script for the program of that name.
std::string bash_completion(const std::string& program, std::span<const Command> commands);
std::string zsh_completion(const std::string& program, std::span<const Command> commands);
std::string fish_completion(const std::string& program, std::span<const Command> commands);

// Returns the extensions (without dots) that a shell should offer; none means any file.
std::vector<std::string> offered_extensions(Offer offer);

// Return the commands that a shell offers, and a command's options with --threads, --quiet, --help.
std::vector<Command> offered_commands(std::span<const Command> commands);
std::vector<Option> offered_options(const Command& command);

// Returns the text with "@program@" and, in names of functions, "@function@" replaced.
std::string of_program(std::string text, const std::string& program);

// Returns the first clause of a help text, which fits into a list of completions.
std::string first_clause(const std::string& help);

}  // namespace rholm::cli
