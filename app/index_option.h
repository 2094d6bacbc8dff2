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

/// Return the folders for copies of `import --copy`, and for what archives send.
std::string copiesFolder(const std::string& indexFolder);
std::string fetchedFolder(const std::string& indexFolder);

}  // namespace volumen
