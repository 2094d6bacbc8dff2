#include "io/index/schema.h"

#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <QDateTime>
#include <QThread>
#include <array>
#include <cstdio>
#include <filesystem>

#include "io/files/lock_file.h"

namespace volumen {
namespace {

constexpr std::int64_t applicationId = 0x766f6c75;  // "volu"

const std::array<SchemaStep, 3> indexSchema{
    SchemaStep{
        "CREATE TABLE folder(id INTEGER PRIMARY KEY, path BLOB NOT NULL UNIQUE, device INTEGER NOT NULL)",
        "CREATE TABLE study(id INTEGER PRIMARY KEY, key BLOB NOT NULL UNIQUE, uid TEXT NOT NULL,"
        " patient_name TEXT NOT NULL, patient_id TEXT NOT NULL, birth_date TEXT NOT NULL, sex TEXT NOT NULL,"
        " date TEXT NOT NULL, time TEXT NOT NULL, description TEXT NOT NULL, accession TEXT NOT NULL,"
        " words TEXT NOT NULL DEFAULT '', imported_at TEXT NOT NULL, opened_at TEXT NOT NULL DEFAULT '',"
        " forgotten_at TEXT NOT NULL DEFAULT '', empty_at TEXT NOT NULL DEFAULT '')",
        "CREATE TABLE series(id INTEGER PRIMARY KEY, study_id INTEGER NOT NULL REFERENCES study(id) ON DELETE"
        " CASCADE, key BLOB NOT NULL, uid TEXT NOT NULL, number TEXT NOT NULL, modality TEXT NOT NULL,"
        " description TEXT NOT NULL, date TEXT NOT NULL, time TEXT NOT NULL, label TEXT NOT NULL,"
        " is_volume INTEGER NOT NULL, images INTEGER NOT NULL DEFAULT 0, frames INTEGER NOT NULL DEFAULT 0,"
        " stale INTEGER NOT NULL DEFAULT 0, UNIQUE(study_id, key))",
        "CREATE TABLE warning(series_id INTEGER NOT NULL REFERENCES series(id) ON DELETE CASCADE,"
        " position INTEGER NOT NULL, sentence TEXT NOT NULL, PRIMARY KEY(series_id, position)) WITHOUT ROWID",
        "CREATE TABLE file(id INTEGER PRIMARY KEY, folder_id INTEGER NOT NULL REFERENCES folder(id),"
        " name BLOB NOT NULL, size INTEGER NOT NULL, mtime_ns INTEGER NOT NULL, ctime_ns INTEGER NOT NULL,"
        " inode INTEGER NOT NULL, device INTEGER NOT NULL, series_id INTEGER REFERENCES series(id) ON DELETE"
        " CASCADE, sop_uid TEXT NOT NULL DEFAULT '', volume INTEGER NOT NULL DEFAULT 0,"
        " position INTEGER NOT NULL DEFAULT 0, frames INTEGER NOT NULL DEFAULT 0,"
        " reason TEXT NOT NULL DEFAULT '', program TEXT NOT NULL DEFAULT '', UNIQUE(folder_id, name))",
        "CREATE INDEX file_series ON file(series_id)",
        "CREATE INDEX file_inode ON file(inode)",
    },
    // Lists ask which folders a series lies in and what was refused there, without a look at every file.
    SchemaStep{
        "CREATE TABLE series_folder(series_id INTEGER NOT NULL REFERENCES series(id) ON DELETE CASCADE,"
        " folder_id INTEGER NOT NULL REFERENCES folder(id), PRIMARY KEY(series_id, folder_id)) WITHOUT ROWID",
        "INSERT INTO series_folder SELECT DISTINCT series_id, folder_id FROM file WHERE series_id IS NOT "
        "NULL",
        "CREATE INDEX file_refused ON file(folder_id) WHERE reason <> ''",
    },
    // NULL: not known yet; the next import reads it (Import::readInstitutions).
    SchemaStep{"ALTER TABLE study ADD COLUMN institution TEXT"}};

const std::array<SchemaStep, 1> thumbnailSchema{SchemaStep{
    "CREATE TABLE thumbnail(key BLOB PRIMARY KEY, made_of BLOB NOT NULL, png BLOB NOT NULL) WITHOUT ROWID"}};

/// Whether the last page is cut off, which SQLite takes for zeros. (While there is a log, it may hold the
/// rest.)
bool isCutOff(Database& db) {
  std::error_code error, noLog;
  const std::int64_t page = db.number("PRAGMA page_size");
  const std::uintmax_t size = std::filesystem::file_size(db.path(), error);
  const std::uintmax_t log = std::filesystem::file_size(db.path() + "-wal", noLog);
  return !error && page > 0 && size % std::uintmax_t(page) != 0 && (noLog || log == 0);
}

enum class Health { good, outdated, newer, damaged, unknown };

/// unknown: the database has failed for a reason that is no fault of the file's.
Health examine(Database& db, std::size_t newest) {
  const std::int64_t id = db.number("PRAGMA application_id");
  const std::int64_t version = db.number("PRAGMA user_version");
  const std::int64_t tables = db.number("SELECT COUNT(*) FROM sqlite_master");
  bool whole = false;
  if (Rows check = db.run("PRAGMA quick_check(1)"); check.next()) whole = check.text(0) == "ok";
  if (db.failed()) return db.damaged() ? Health::damaged : Health::unknown;
  if (!whole || isCutOff(db)) return Health::damaged;
  if (id == 0 && version == 0 && tables == 0) return Health::outdated;
  if (id != applicationId) return Health::damaged;
  if (version > std::int64_t(newest)) return Health::newer;
  return version == std::int64_t(newest) ? Health::good : Health::outdated;
}

Status update(Database& db, std::span<const SchemaStep> steps) {
  db.begin();
  const auto version = std::size_t(db.number("PRAGMA user_version"));
  for (std::size_t n = version; n < steps.size(); ++n)
    for (const char* statement : steps[n]) db.run(statement);
  db.runOnce("PRAGMA application_id = " + std::to_string(applicationId));
  db.runOnce("PRAGMA user_version = " + std::to_string(steps.size()));
  return db.commit();
}

/// Memory that programs share, which WAL needs, is not to be had on disks of other machines.
bool isNetworkDisk(const std::string& folder) {
  struct statfs disk {};
  if (statfs(folder.c_str(), &disk) != 0) return false;
  constexpr unsigned nfs = 0x6969, smb = 0x517b, cifs = 0xff534d42, smb2 = 0xfe534d42, fuse = 0x65735546,
                     plan9 = 0x01021997, ceph = 0x00c36400, lustre = 0x0bd00bd0, afs = 0x5346414f,
                     gpfs = 0x47504653;
  for (const unsigned type : {nfs, smb, cifs, smb2, fuse, plan9, ceph, lustre, afs, gpfs})
    if (unsigned(disk.f_type) == type) return true;
  return false;
}

Status configure(Database& db, const std::string& folder) {
  db.run(isNetworkDisk(folder) ? "PRAGMA journal_mode = DELETE" : "PRAGMA journal_mode = WAL");
  db.run("PRAGMA synchronous = NORMAL");
  db.run("PRAGMA foreign_keys = ON");
  return db.takeStatus();
}

/// Renames a database and what belongs to it.
Status setAside(const std::string& path, const std::string& name) {
  for (const char* part : {"", "-wal", "-shm", "-journal"})
    if (std::rename((path + part).c_str(), (name + part).c_str()) != 0 && errno != ENOENT)
      return Error{"Cannot rename " + path + part + ", which is damaged: " + std::strerror(errno) + "."};
  return {};
}

/// Waits for another program that repairs, makes or updates a database here: some seconds, no more.
std::optional<LockFile> lockOf(const std::string& folder) {
  for (int n = 0; n < 2000; ++n) {
    if (std::optional<LockFile> lock = LockFile::take(folder + "/index.lock")) return lock;
    QThread::msleep(5);
  }
  return {};
}

struct Examined {
  std::unique_ptr<Database> database;
  Health health;
};

Result<Examined> openAndExamine(const std::string& path, std::size_t newest) {
  Result<std::unique_ptr<Database>> opened = Database::open(path);
  if (!opened) return opened.error();
  const Health health = examine(**opened, newest);
  const Status status = (*opened)->takeStatus();
  if (health == Health::unknown) return status.error();
  return Examined{std::move(*opened), health};
}

/// Renames a database that cannot be used and says so.
Result<std::string> replace(const std::string& path, Health health) {
  const bool newer = health == Health::newer;
  const QString now = QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyyMMddThhmmsszzz"));
  const std::string aside = path + (newer ? ".newer-" : ".damaged-") + now.toStdString();
  if (Status renamed = setAside(path, aside); !renamed) return renamed.error();
  return std::string(newer ? "The index is of a newer volumen" : "The index was damaged") +
         ": it was renamed to " + aside + ", and a new one was made. Import your folders again.";
}

/// Makes of what was found a database that can be used. Only one program at a time does so.
Result<OpenedDatabase> repaired(const std::string& folder, const std::string& path,
                                std::span<const SchemaStep> steps) {
  const std::optional<LockFile> lock = lockOf(folder);
  OpenedDatabase out;
  Result<Examined> found = openAndExamine(path, steps.size());
  if (found && (found->health == Health::newer || found->health == Health::damaged)) {
    found->database.reset();
    Result<std::string> notice = replace(path, found->health);
    if (!notice) return notice.error();
    out.notice = std::move(*notice);
    found = openAndExamine(path, steps.size());
  }
  if (!found) return found.error();
  if (found->health == Health::outdated)
    if (Status updated = update(*found->database, steps); !updated) return updated.error();
  chmod(path.c_str(), S_IRUSR | S_IWUSR);  // it names patients; its log takes the same rights
  out.database = std::move(found->database);
  return out;
}

Result<OpenedDatabase> openDatabase(const std::string& folder, const char* name,
                                    std::span<const SchemaStep> steps) {
  if (Status made = makePrivateFolder(folder); !made) return made.error();
  const std::string path = folder + "/" + name;
  Result<Examined> found = openAndExamine(path, steps.size());
  if (!found) return found.error();
  OpenedDatabase out{std::move(found->database), {}};
  if (found->health != Health::good) {
    out.database.reset();
    Result<OpenedDatabase> whole = repaired(folder, path, steps);
    if (!whole) return whole.error();
    out = std::move(*whole);
  }
  if (Status ready = configure(*out.database, folder); !ready) return ready.error();
  return out;
}

}  // namespace

std::span<const SchemaStep> indexSteps() { return indexSchema; }

Status makePrivateFolder(const std::string& folder) {
  std::error_code error;
  const bool made = std::filesystem::create_directories(folder, error);
  if (made) std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
  if (error) return Error{"Cannot make the folder " + folder + ": " + error.message() + "."};
  if (access(folder.c_str(), W_OK) != 0)
    return Error{"Cannot write to the folder " + folder + ": " + std::strerror(errno) + "."};
  return {};
}

Result<OpenedDatabase> openIndexDatabase(const std::string& folder) {
  return openDatabase(folder, "index.sqlite", indexSchema);
}

Result<OpenedDatabase> openThumbnailDatabase(const std::string& folder) {
  return openDatabase(folder, "thumbnails.sqlite", thumbnailSchema);
}

}  // namespace volumen
