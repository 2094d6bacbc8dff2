#pragma once

#include <CLI/CLI.hpp>

namespace volumen {

/// Adds --list-presets: writes the names of all presets, one a line, and ends the program; a PATH is not
/// needed.
void addListPresets(CLI::App& app);

}  // namespace volumen
