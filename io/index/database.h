#pragma once

#include <QSqlDatabase>
#include <QSqlQuery>
#include <QVariant>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "viewer/volume/result.h"

namespace volumen {

/// Binary data: paths, images.
struct Blob {
  const std::string& bytes;
};

/// The number of a row in another table; 0 is NULL.
struct RowId {
  std::int64_t id = 0;
};

class Database;

/// The result rows of a statement, one at a time. A statement can have only one Rows at a time.
class Rows {
 public:
  Rows(Database& database, QSqlQuery* query) : database_(&database), query_(query) {}
  Rows(Rows&& other) noexcept : database_(other.database_), query_(std::exchange(other.query_, nullptr)) {}
  Rows& operator=(Rows&&) = delete;
  ~Rows() {
    if (query_) query_->finish();
  }

  /// Goes to the next row. Returns false after the last one, and if the statement failed.
  bool next();
  std::int64_t number(int column) const { return query_->value(column).toLongLong(); }
  std::string text(int column) const { return query_->value(column).toString().toStdString(); }
  std::string bytes(int column) const { return query_->value(column).toByteArray().toStdString(); }

 private:
  Database* database_;
  QSqlQuery* query_;  // null: the statement failed
};

/// A connection to an SQLite file, for one thread. It keeps the first failure: later statements do nothing
/// and return no rows, until takeStatus().
class Database {
 public:
  enum class Access { write, read };  ///< write: creates the file if it is missing

  /// Opens the file without reading it.
  static Result<std::unique_ptr<Database>> open(const std::string& path, Access access = Access::write);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  const std::string& path() const { return path_; }
  bool canWrite() const { return access_ == Access::write; }

  /// Runs a statement; `sql` must live as long as the connection (it is prepared once).
  template <class... Values>
  Rows run(const char* sql, const Values&... values) {
    QSqlQuery* query = prepared(sql);
    if (!query) return {*this, nullptr};
    int position = 0;
    (query->bindValue(position++, variant(values)), ...);
    return executed(query);
  }
  /// Runs a composed statement: pragmas take no values.
  void runOnce(const std::string& sql);
  /// Returns the first number of a statement's result; 0 if there is none.
  template <class... Values>
  std::int64_t number(const char* sql, const Values&... values) {
    Rows rows = run(sql, values...);
    return rows.next() ? rows.number(0) : 0;
  }

  bool failed() const { return failure_ != Failure::none; }
  /// True if the failure shows a damaged file or one that is not a database.
  bool damaged() const { return failure_ == Failure::damaged; }
  /// True if any failure so far did.
  bool wasDamaged() const { return wasDamaged_; }
  /// True if SQLite does not know a name in the statement, or the form of the file.
  bool refused() const { return failure_ == Failure::refused; }
  /// Returns whether the file names a form of a later SQLite, which this one does not write. SQLite is asked:
  /// if this process opened the file by itself, closing it would drop the locks of all its connections
  /// (POSIX, fcntl), and other programs would delete the log in which these go on to write.
  bool isOfUnknownForm() const;
  /// Returns the status since the last call and resets the failure.
  Status takeStatus();

  /// commit() makes all statements since begin() permanent, or undoes them after a failure.
  void begin();
  Status commit();

  /// Used by Rows.
  void noteFailure(const QSqlQuery& query);

 private:
  enum class Failure { none, damaged, refused, other };

  Database(std::string path, QString name, Access access)
      : path_(std::move(path)), name_(std::move(name)), access_(access) {}
  QSqlQuery* prepared(const char* sql);
  Rows executed(QSqlQuery* query);

  static QVariant variant(std::int64_t value) { return QVariant::fromValue<qlonglong>(value); }
  static QVariant variant(int value) { return value; }
  static QVariant variant(bool value) { return int(value); }
  static QVariant variant(const std::string& text) { return QString::fromStdString(text); }
  static QVariant variant(const char* text) { return QString::fromUtf8(text); }
  static QVariant variant(Blob blob) { return QByteArray(blob.bytes.data(), qsizetype(blob.bytes.size())); }
  static QVariant variant(RowId row) {
    return row.id ? QVariant::fromValue<qlonglong>(row.id) : QVariant(QMetaType::fromType<qlonglong>());
  }

  std::string path_;
  QString name_;  // name of the connection
  Access access_;
  std::map<const char*, QSqlQuery> statements_;
  Failure failure_ = Failure::none;
  bool wasDamaged_ = false;
  std::string sentence_;
};

}  // namespace volumen
