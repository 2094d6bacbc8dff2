#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/index/database.h"

namespace volumen {

/// Statements that bring a schema from one version to the next.
using SchemaStep = std::vector<const char*>;

/// Returns the steps of the index schema; `user_version` of a database is the number of steps it has had.
std::span<const SchemaStep> indexSteps();

/// An intact database with the newest schema.
struct OpenedDatabase {
  std::unique_ptr<Database> database;
  std::string notice;  ///< a sentence if the old database was set aside; else empty
};

/// Depth of a database check; quick does not compare indexes with tables.
enum class Check { quick, full };

/// Opens `folder`/index.sqlite, creates it if it is missing, and updates an older schema. A file that is
/// damaged, foreign or of a newer schema is renamed (".damaged", ".newer" and the time follow its name). The
/// Error: the folder cannot be written.
Result<OpenedDatabase> openIndexDatabase(const std::string& folder, Check check = Check::quick);

/// Opens the index in `folder`, even if it cannot be written; creates and renames nothing. The Error: there
/// is none, it is damaged, or of a newer schema.
Result<OpenedDatabase> openIndexAsItIs(const std::string& folder);

/// Opens `folder`/thumbnails.sqlite; it is a cache and is replaced without notice.
Result<OpenedDatabase> openThumbnailDatabase(const std::string& folder);

/// True if a name in the folder of an index belongs to it: a database, its log files, or the lock.
bool isFileOfIndex(const std::string& name);

}  // namespace volumen
