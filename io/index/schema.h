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

/// How closely a database is looked at: quick leaves out whether its indexes say what its tables say.
enum class Check { quick, full };

/// Opens `folder`/index.sqlite, makes it where it is not there, and brings an older schema up to date. One
/// that is damaged, of another program or of a newer schema is renamed (".damaged", ".newer" and the time
/// behind its name). An Error where the folder cannot be written.
Result<OpenedDatabase> openIndexDatabase(const std::string& folder, Check check = Check::quick);

/// Opens the index that is in `folder`, also where it cannot be written, and makes and renames nothing. An
/// Error where there is none, and where it is damaged or of a newer schema.
Result<OpenedDatabase> openIndexAsItIs(const std::string& folder);

/// Opens `folder`/thumbnails.sqlite, which is made anew in silence: it is only a cache.
Result<OpenedDatabase> openThumbnailDatabase(const std::string& folder);

/// Whether a file in the folder of an index is part of it, by its name: a database, what belongs to it, or
/// the lock.
bool isFileOfIndex(const std::string& name);

}  // namespace volumen
