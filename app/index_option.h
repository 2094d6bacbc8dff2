#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "io/index/index.h"

namespace volumen {

/// Adds --index FOLDER, for commands that use the index.
void addIndex(CLI::App& app, std::string& folder);

/// Opens the index in a folder (empty: the user's own) for an import; creates or repairs it (Index::open()).
/// The Error is a sentence for the user.
Result<Index> openIndex(const std::string& folder);

/// Opens an existing index without changes (Index::openAsItIs()).
Result<Index> openExistingIndex(const std::string& folder);

/// Returns this folder, or the user's own if it is empty.
std::string indexFolderOr(const std::string& folder);

/// Returns the folder for copies of `import --copy`.
std::string copiesFolder(const std::string& indexFolder);

}  // namespace volumen
