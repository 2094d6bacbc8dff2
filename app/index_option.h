#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "io/index/index.h"

namespace volumen {

/// --index FOLDER of the commands that work on the index.
void addIndex(CLI::App& app, std::string& folder);

/// Opens the index in a folder (empty: the user's own); what is to be said of it goes to stderr. The Error is
/// a sentence for the user.
Result<Index> openIndex(const std::string& folder);

/// The same of one that is only looked at: a folder that is named and holds none is refused, none is made
/// there.
Result<Index> openExistingIndex(const std::string& folder);

/// Where `import --copy` copies to.
std::string copiesFolder(const std::string& indexFolder);

}  // namespace volumen
