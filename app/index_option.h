#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "io/index/index.h"

namespace volumen {

/// Adds --index FOLDER, for commands that use the index.
void addIndex(CLI::App& app, std::string& folder);

/// Opens an existing index (empty: the user's own) without changes (Index::openAsItIs()).
Result<Index> openExistingIndex(const std::string& folder);

/// Returns this folder, or if it is empty, the user's own (userIndexFolder()).
std::string indexFolderOr(const std::string& folder);

/// Returns the folder for copies of `import --copy`.
std::string copiesFolder(const std::string& indexFolder);

}  // namespace volumen
