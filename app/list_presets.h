#pragma once

#include <CLI/CLI.hpp>

namespace volumen {

/// Adds --list-presets, which prints the names of all presets, one a line, and ends the program without a
/// PATH.
void addListPresets(CLI::App& app);

}  // namespace volumen
