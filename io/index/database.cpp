#include "io/index/database.h"

#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QSqlError>
#include <QUrl>
#include <atomic>
#include <filesystem>

namespace volumen {
namespace {

// SQLite's result codes (sqlite.org/rescode.html) without their extensions.
enum Code {
  wrongStatement = 1,
  busy = 5,
  locked = 6,
  readOnly = 8,
  ioError = 10,
  corrupt = 11,
  full = 13,
  cannotOpen = 14,
  notADatabase = 26
};

// How long a statement waits for other programs, which write an import in batches of some seconds each on a
// slow machine.
constexpr int waitForOthersMs = 60000;

Code codeOf(const QSqlError& error) { return Code(error.nativeErrorCode().toInt() & 0xff); }

std::string reasonOf(const QSqlError& error) {
  switch (codeOf(error)) {
    case full:
      return "the disk is full; what was written before is kept";
    case busy:
    case locked:
      return "another program keeps writing to it; try again";
    case readOnly:
    case cannotOpen:
      return "it cannot be written; check the rights of its folder";
    case corrupt:
    case notADatabase:
      return "it is damaged; `volumen import PATH` makes it anew";
    case ioError:
      return "the disk is full or fails; what was written before is kept";
    case wrongStatement:
      break;
  }
  return error.text().toStdString();
}

// True if a program has the database open for writing: a log exists as long as one does.
bool isBeingWritten(const std::string& path) {
  std::error_code none;
  return std::filesystem::exists(path + "-wal", none);
}

QString newConnectionName() {
  static std::atomic<int> next{0};
  return QStringLiteral("volumen index %1").arg(++next);
}

}  // namespace

bool Rows::next() {
  if (!query_) return false;
  if (query_->next()) return true;
  if (query_->lastError().isValid()) database_->noteFailure(*query_);
  return false;
}

Result<std::unique_ptr<Database>> Database::open(const std::string& path, Access access) {
  if (!QSqlDatabase::isDriverAvailable(QStringLiteral("QSQLITE")))
    return Error{"Cannot open the index: Qt's driver for SQLite is missing; install libqt6sql6-sqlite."};
  std::unique_ptr<Database> database(new Database(path, newConnectionName(), access));
  QSqlDatabase connection = QSqlDatabase::addDatabase(QStringLiteral("QSQLITE"), database->name_);
  QString name = QFile::decodeName(path.c_str()),
          options = QStringLiteral("QSQLITE_BUSY_TIMEOUT=%1").arg(waitForOthersMs);
  if (access == Access::read) options += QStringLiteral(";QSQLITE_OPEN_READONLY");
  if (access == Access::read && !isBeingWritten(path)) {
    // Without this, SQLite would try to create files beside it.
    name = QUrl::fromLocalFile(QDir().absoluteFilePath(name)).toString(QUrl::FullyEncoded) +
           QStringLiteral("?immutable=1");
    options += QStringLiteral(";QSQLITE_OPEN_URI");
  }
  connection.setDatabaseName(name);
  connection.setConnectOptions(options);
  if (!connection.open())
    return Error{"Cannot open the index " + path + ": " + reasonOf(connection.lastError()) + "."};
  return database;
}

Database::~Database() {
  statements_.clear();
  QSqlDatabase::database(name_, false).close();
  QSqlDatabase::removeDatabase(name_);
}

QSqlQuery* Database::prepared(const char* sql) {
  if (failed()) return nullptr;
  const auto known = statements_.find(sql);
  if (known != statements_.end()) return &known->second;
  QSqlQuery query(QSqlDatabase::database(name_, false));
  query.setForwardOnly(true);
  if (!query.prepare(QString::fromUtf8(sql))) {
    noteFailure(query);
    return nullptr;
  }
  return &statements_.emplace(sql, std::move(query)).first->second;
}

Rows Database::executed(QSqlQuery* query) {
  if (query->exec()) return {*this, query};
  noteFailure(*query);
  return {*this, nullptr};
}

void Database::runOnce(const std::string& sql) {
  if (failed()) return;
  QSqlQuery query(QSqlDatabase::database(name_, false));
  if (!query.exec(QString::fromStdString(sql))) noteFailure(query);
}

void Database::noteFailure(const QSqlQuery& query) {
  if (failed()) return;
  const Code code = codeOf(query.lastError());
  failure_ = code == corrupt || code == notADatabase ? Failure::damaged
             : code == wrongStatement                ? Failure::refused
                                                     : Failure::other;
  wasDamaged_ = wasDamaged_ || damaged();
  sentence_ = "The index " + path_ + " failed: " + reasonOf(query.lastError()) + ".";
}

bool Database::isOfUnknownForm() const {
  const std::string folder = std::filesystem::path(path_).parent_path().string();
  if (!canWrite() || access(path_.c_str(), W_OK) != 0 || access(folder.c_str(), W_OK) != 0) return false;
  QSqlQuery query(QSqlDatabase::database(name_, false));
  query.exec(QStringLiteral("PRAGMA busy_timeout = 0"));  // who writes proves that it can be written
  const bool isBegun = query.exec(QStringLiteral("BEGIN IMMEDIATE"));
  const bool isReadOnly = isBegun && !query.exec(QStringLiteral("PRAGMA user_version = 0")) &&
                          codeOf(query.lastError()) == readOnly;
  if (isBegun) query.exec(QStringLiteral("ROLLBACK"));
  query.exec(QStringLiteral("PRAGMA busy_timeout = %1").arg(waitForOthersMs));
  return isReadOnly;
}

Status Database::takeStatus() {
  if (!failed()) return {};
  failure_ = Failure::none;
  return Error{std::move(sentence_)};
}

void Database::begin() { run("BEGIN IMMEDIATE"); }

Status Database::commit() {
  run("COMMIT");
  const Status status = takeStatus();
  if (status) return {};
  // SQLite has already rolled back after some failures; this statement then fails harmlessly.
  run("ROLLBACK");
  (void)takeStatus().ok();
  return status;
}

}  // namespace volumen
