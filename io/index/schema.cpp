#include "io/index/schema.h"

#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <QDateTime>
#include <QThread>
#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/files/lock_file.h"
#include "io/files/private_folder.h"
#include "io/index/files_below.h"

namespace volumen {
namespace {

constexpr std::int64_t applicationId = 0x766f6c75;  // "volu"
constexpr const char* lockName = "index.lock";

const std::array<SchemaStep, 4> indexSchema{
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
    // Lists need a series' folders and refused files without scanning all files.
    SchemaStep{
        "CREATE TABLE series_folder(series_id INTEGER NOT NULL REFERENCES series(id) ON DELETE CASCADE,"
        " folder_id INTEGER NOT NULL REFERENCES folder(id), PRIMARY KEY(series_id, folder_id)) WITHOUT ROWID",
        "INSERT INTO series_folder SELECT DISTINCT series_id, folder_id FROM file WHERE series_id IS NOT "
        "NULL",
        "CREATE INDEX file_refused ON file(folder_id) WHERE reason <> ''",
    },
    // NULL: not known yet; the next import reads it (Import::readInstitutions).
    SchemaStep{"ALTER TABLE study ADD COLUMN institution TEXT"},
    // A file that is not an image but missing in a series is reported as such, not as refused.
    SchemaStep{"ALTER TABLE file ADD COLUMN no_image INTEGER NOT NULL DEFAULT 0"}};

const std::array<SchemaStep, 1> thumbnailSchema{SchemaStep{
    "CREATE TABLE thumbnail(key BLOB PRIMARY KEY, made_of BLOB NOT NULL, png BLOB NOT NULL) WITHOUT ROWID"}};

// True if the last page is cut off; SQLite reads the rest as zeros. (A log may hold the rest.)
bool isCutOff(Database& db) {
  std::error_code error, noLog;
  const std::int64_t page = db.number("PRAGMA page_size");
  const std::uintmax_t size = std::filesystem::file_size(db.path(), error);
  const std::uintmax_t log = std::filesystem::file_size(db.path() + "-wal", noLog);
  return !error && page > 0 && size % std::uintmax_t(page) != 0 && (noLog || log == 0);
}

// Returns the definitions of a database's tables and indexes without spaces.
std::vector<std::string> tablesOf(Database& db) {
  std::vector<std::string> all;
  for (Rows rows = db.run("SELECT type, name, tbl_name, IFNULL(sql, '') FROM sqlite_master ORDER BY name");
       rows.next();) {
    std::string text;
    for (int column = 0; column < 4; ++column) text += rows.text(column) + '|';
    std::erase(text, ' ');
    all.push_back(std::move(text));
  }
  return all;
}

// Returns the definitions that these steps make in a new database.
std::vector<std::string> tablesMadeBy(std::span<const SchemaStep> steps) {
  const Result<std::unique_ptr<Database>> db = Database::open(":memory:");
  if (!db) return {};
  for (const SchemaStep& step : steps)
    for (const char* statement : step) (*db)->run(statement);
  return tablesOf(**db);
}

enum class Health { good, outdated, newer, damaged, unknown };

// Returns `unknown` if the database failed for a reason outside the file.
Health examine(Database& db, std::span<const SchemaStep> steps, Check check) {
  const std::int64_t id = db.number("PRAGMA application_id");
  const std::int64_t version = db.number("PRAGMA user_version");
  const std::vector<std::string> tables = tablesOf(db);
  bool whole = false;
  if (Rows found = db.run(check == Check::quick ? "PRAGMA quick_check(1)" : "PRAGMA integrity_check(1)");
      found.next())
    whole = found.text(0) == "ok";
  if (db.failed()) return db.damaged() || db.refused() ? Health::damaged : Health::unknown;
  if (!whole || isCutOff(db) || db.isOfUnknownForm() || id != applicationId) return Health::damaged;
  if (version > std::int64_t(steps.size())) return Health::newer;
  if (version < 1 || tables != tablesMadeBy(steps.first(std::size_t(version)))) return Health::damaged;
  return version == std::int64_t(steps.size()) ? Health::good : Health::outdated;
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

// WAL needs shared memory between programs, which network disks lack.
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

// Renames a database and its log files.
Status setAside(const std::string& path, const std::string& name) {
  for (const char* part : {"", "-wal", "-shm", "-journal"})
    if (std::rename((path + part).c_str(), (name + part).c_str()) != 0 && errno != ENOENT)
      return Error{"Cannot rename " + path + part + ", which is damaged: " + std::strerror(errno) + "."};
  return {};
}

// Waits up to ten seconds for another program that repairs, creates or updates a database here.
std::optional<LockFile> lockOf(const std::string& folder) {
  for (int n = 0; n < 2000; ++n) {
    if (std::optional<LockFile> lock = LockFile::take(folder + "/" + lockName)) return lock;
    QThread::msleep(5);
  }
  return {};
}

struct Examined {
  std::unique_ptr<Database> database;
  Health health;
};

Result<Examined> openAndExamine(const std::string& path, std::span<const SchemaStep> steps, Check check,
                                Database::Access access = Database::Access::write) {
  Result<std::unique_ptr<Database>> opened = Database::open(path, access);
  if (!opened) return opened.error();
  const Health health = examine(**opened, steps, check);
  const Status status = (*opened)->takeStatus();
  if (health == Health::unknown) return status.error();
  return Examined{std::move(*opened), health};
}

// Renames an unusable database and returns a notice.
Result<std::string> replace(const std::string& path, Health health) {
  const bool newer = health == Health::newer;
  const QString now = QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyyMMddThhmmsszzz"));
  const std::string aside = path + (newer ? ".newer-" : ".damaged-") + now.toStdString();
  if (Status renamed = setAside(path, aside); !renamed) return renamed.error();
  return std::string(newer ? "The index is of a newer volumen" : "The index was damaged") +
         ": it was renamed to " + aside + ", and a new one was made. Import your folders again.";
}

// Creates a database under a temporary name until it is complete: one without tables would count as damaged.
Status make(const std::string& path, std::span<const SchemaStep> steps) {
  const std::string aside = path + ".new";
  std::error_code error;
  for (const char* part : {"", "-journal"}) std::filesystem::remove(aside + part, error);
  {
    const Result<std::unique_ptr<Database>> db = Database::open(aside);
    if (!db) return db.error();
    if (Status made = update(**db, steps); !made) return made;
  }
  chmod(aside.c_str(), S_IRUSR | S_IWUSR);  // it names patients; its log gets the same permissions
  if (std::rename(aside.c_str(), path.c_str()) != 0)
    return Error{"Cannot make the index " + path + ": " + std::strerror(errno) + "."};
  return {};
}

// Repairs, creates or updates a database. Only one program at a time does so.
Result<OpenedDatabase> mended(const std::string& folder, const std::string& path,
                              std::span<const SchemaStep> steps, Check check) {
  const std::optional<LockFile> lock = lockOf(folder);
  OpenedDatabase out;
  if (exists(path)) {
    Result<Examined> found = openAndExamine(path, steps, check);
    if (!found) return found.error();
    found->database.reset();
    if (found->health == Health::newer || found->health == Health::damaged) {
      Result<std::string> notice = replace(path, found->health);
      if (!notice) return notice.error();
      out.notice = std::move(*notice);
    }
  }
  if (!exists(path))
    if (Status made = make(path, steps); !made) return made.error();
  Result<Examined> found = openAndExamine(path, steps, Check::quick);
  if (!found) return found.error();
  if (found->health == Health::outdated)
    if (Status updated = update(*found->database, steps); !updated) return updated.error();
  out.database = std::move(found->database);
  return out;
}

// Opens a database if it is intact and up to date; else returns null.
Result<std::unique_ptr<Database>> whole(const std::string& path, std::span<const SchemaStep> steps) {
  if (!exists(path)) return std::unique_ptr<Database>();
  Result<Examined> found = openAndExamine(path, steps, Check::quick);
  if (!found) return found.error();
  return found->health == Health::good ? std::move(found->database) : std::unique_ptr<Database>();
}

Result<OpenedDatabase> openDatabase(const std::string& folder, const char* name,
                                    std::span<const SchemaStep> steps, Check check) {
  if (Status made = makePrivateFolder(folder); !made) return made.error();
  const std::string path = folder + "/" + name;
  Result<OpenedDatabase> out = OpenedDatabase{};
  if (check == Check::quick) {
    Result<std::unique_ptr<Database>> there = whole(path, steps);
    if (!there) return there.error();
    out->database = std::move(*there);
  }
  if (!out->database) out = mended(folder, path, steps, check);
  if (!out) return out;
  if (Status ready = configure(*out->database, folder); !ready) return ready.error();
  return out;
}

}  // namespace

std::span<const SchemaStep> indexSteps() { return indexSchema; }

bool isFileOfIndex(const std::string& name) {
  return name == lockName || name.starts_with("index.sqlite") || name.starts_with("thumbnails.sqlite");
}

Result<OpenedDatabase> openIndexDatabase(const std::string& folder, Check check) {
  return openDatabase(folder, "index.sqlite", indexSchema, check);
}

Result<OpenedDatabase> openThumbnailDatabase(const std::string& folder) {
  return openDatabase(folder, "thumbnails.sqlite", thumbnailSchema, Check::quick);
}

Result<OpenedDatabase> openIndexAsItIs(const std::string& folder) {
  const std::string path = folder + "/index.sqlite";
  if (!exists(path)) return Error{"There is no index in " + folder + ": `volumen import PATH` makes one."};
  const bool writable = access(folder.c_str(), W_OK) == 0 && access(path.c_str(), W_OK) == 0;
  Result<Examined> found = openAndExamine(path, indexSchema, Check::quick,
                                          writable ? Database::Access::write : Database::Access::read);
  if (!found) return found.error();
  switch (found->health) {
    case Health::damaged:
      return Error{"The index " + path + " is damaged: `volumen import PATH` makes it anew."};
    case Health::newer:
      return Error{"The index " + path +
                   " is of a newer volumen: `volumen import PATH` makes one of this version."};
    case Health::outdated:
      if (writable) return openIndexDatabase(folder, Check::quick);
      return Error{"The index " + path +
                   " is of an older volumen and cannot be written: bring it up to date with `volumen import "
                   "PATH` where it can."};
    case Health::good:
    case Health::unknown:
      break;
  }
  if (writable)
    if (Status ready = configure(*found->database, folder); !ready) return ready.error();
  return OpenedDatabase{std::move(found->database), {}};
}

}  // namespace volumen
