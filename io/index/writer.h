#pragma once

#include <map>
#include <set>

#include "io/index/database.h"
#include "io/index/reading.h"

namespace volumen {

/// Writes what was read into the index. All of it happens between begin() and commit() of the database;
/// failures are the database's.
class Writer {
 public:
  explicit Writer(Database& db) : db_(db) {}

  /// Everything of a batch of files. A series that has more files than these is marked to be read as a whole.
  void write(const std::vector<FileOnDisk>& files, const ReadFiles& read);
  /// A file that is in no series, with the reason why it is not; `isImage`: it was refused.
  void writeOther(const FileOnDisk& file, const std::string& reason, bool isImage);
  /// Where a study of the index was made.
  void setInstitution(std::int64_t study, const std::string& institution);
  /// A file is at another place now; what is known of it stays.
  void move(std::int64_t file, const FileOnDisk& to);
  /// A file is no longer there.
  void remove(std::int64_t file);
  /// Brings what is counted of the series and studies that were touched up to date, and takes away those that
  /// have no files.
  void finish();

 private:
  std::int64_t folderId(const std::string& path);
  std::int64_t studyId(const ReadSeries& series, std::int64_t known);
  std::int64_t seriesId(std::int64_t study, const ReadSeries& series, std::int64_t known);
  std::int64_t knownSeries(const FileOnDisk& file);
  void writeSeries(const ReadSeries& series, const std::map<std::string, const FileOnDisk*>& onDisk);
  void writeFile(const FileOnDisk& file, std::int64_t series, const FoundFile& found, int position);
  /// The series of a folder are read anew: what is told of them may name its files.
  void tellAnew(std::int64_t folder);
  void lose(std::int64_t series);
  void dropMoved(std::int64_t series);
  void finishSeries(std::int64_t series);
  void finishStudy(std::int64_t study);

  Database& db_;
  std::set<std::int64_t> series_, studies_;       // touched
  std::set<std::int64_t> lost_;                   // series that lost files
  std::map<std::int64_t, std::int64_t> written_;  // series, how many of its files were written together
  std::map<std::string, std::int64_t> folders_;
};

/// Now, ISO 8601 with milliseconds, UTC.
std::string timeNow();

}  // namespace volumen
