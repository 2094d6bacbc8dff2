#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/index/database.h"

namespace volumen {

/// What brings a schema from one version to the next: statements.
using SchemaStep = std::vector<const char*>;

/// The steps of the index from nothing on: `user_version` of a database says how many it has had.
std::span<const SchemaStep> indexSteps();

/// A database that is whole and of the newest schema.
struct OpenedDatabase {
  std::unique_ptr<Database> database;
  std::string notice;  ///< that the one before was set aside, and why: a sentence; empty: it was not
};

/// Opens `folder`/index.sqlite, makes it where it is not there, and brings an older schema up to date. One
/// that is damaged, of another program or of a newer schema is renamed (".damaged", ".newer" and the time
/// behind its name). An Error where the folder cannot be written.
Result<OpenedDatabase> openIndexDatabase(const std::string& folder);

/// The same of `folder`/thumbnails.sqlite, which is made anew in silence: it is only a cache.
Result<OpenedDatabase> openThumbnailDatabase(const std::string& folder);

/// Makes `folder`, for its owner alone, where it is not there.
Status makePrivateFolder(const std::string& folder);

}  // namespace volumen
