// Completions for shells, made from the descriptions of the commands. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// Of the program of that name.
std::string bash_completion(const std::string& program, std::span<const Command> commands);
std::string zsh_completion(const std::string& program, std::span<const Command> commands);
std::string fish_completion(const std::string& program, std::span<const Command> commands);

// Extensions (without dots) a shell should offer; none means any file. Shared by the three.
std::vector<std::string> offered_extensions(Offer offer);

// The commands a shell offers, and the options of one with --threads, --quiet and --help.
std::vector<Command> offered_commands(std::span<const Command> commands);
std::vector<Option> offered_options(const Command& command);

// The text with "@program@" and, in names of functions, "@function@" replaced.
std::string of_program(std::string text, const std::string& program);

// What fits into a list of completions: the first clause of a help text.
std::string first_clause(const std::string& help);

}  // namespace rholm::cli
