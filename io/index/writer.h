#pragma once

#include <map>
#include <set>

#include "io/index/database.h"
#include "io/index/reading.h"

namespace volumen {

/// Writes read files into the index, between begin() and commit() of the database. The database keeps
/// failures.
class Writer {
 public:
  explicit Writer(Database& db) : db_(db) {}

  /// Writes a batch of files. A series with further files is marked to be read as a whole.
  void write(const std::vector<FileOnDisk>& files, const ReadFiles& read);
  /// Writes a file that is in no series, with the reason; `isImage` means that it was refused.
  void writeOther(const FileOnDisk& file, const std::string& reason, bool isImage);
  /// Sets the institution of a study.
  void setInstitution(std::int64_t study, const std::string& institution);
  /// Changes the path of a file and keeps its other data.
  void move(std::int64_t file, const FileOnDisk& to);
  /// Removes a deleted file.
  void remove(std::int64_t file);
  /// Updates counts of changed series and studies, and removes those without files.
  void finish();

 private:
  std::int64_t folderId(const std::string& path);
  std::int64_t studyId(const ReadSeries& series, std::int64_t known);
  std::int64_t seriesId(std::int64_t study, const ReadSeries& series, std::int64_t known);
  std::int64_t knownSeries(const FileOnDisk& file);
  void writeSeries(const ReadSeries& series, const std::map<std::string, const FileOnDisk*>& onDisk);
  void writeFile(const FileOnDisk& file, std::int64_t series, const FoundFile& found, int position);
  /// Marks the series of a folder to be read again: their warnings may name its files.
  void tellAnew(std::int64_t folder);
  void lose(std::int64_t series);
  void dropMoved(std::int64_t series);
  void finishSeries(std::int64_t series);
  void finishStudy(std::int64_t study);

  Database& db_;
  std::set<std::int64_t> series_, studies_;       // changed series and studies
  std::set<std::int64_t> lost_;                   // series that lost files
  std::map<std::int64_t, std::int64_t> written_;  // for each series, the number of files written together
  std::map<std::string, std::int64_t> folders_;
};

/// Returns the current time, ISO 8601 with milliseconds, UTC.
std::string timeNow();

}  // namespace volumen
