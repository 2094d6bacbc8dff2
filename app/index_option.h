#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "io/index/index.h"

namespace volumen {

/// --index FOLDER of the commands that work on the index.
void addIndex(CLI::App& app, std::string& folder);

/// Opens the index in a folder (empty: the user's own) to import into it: makes or mends it (Index::open()).
/// The Error is a sentence for the user.
Result<Index> openIndex(const std::string& folder);

/// Opens one that is there as it is (Index::openAsItIs()).
Result<Index> openExistingIndex(const std::string& folder);

/// Where `import --copy` copies to.
std::string copiesFolder(const std::string& indexFolder);

}  // namespace volumen
