#pragma once

#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/index/files_below.h"
#include "io/index/index.h"
#include "io/index/writer.h"

namespace volumen {

/// One import into the index: searches paths, reads new and changed files, and records deleted ones. It
/// writes batch by batch, so that it can be stopped at any moment. Series written in parts are marked, and
/// read as a whole at the end (or by the next import).
class Import {
 public:
  /// `indexFolder` is the folder of the index, whose own files are skipped. With `again`, refused files are
  /// read again.
  Import(Database& db, const std::string& indexFolder, const Progress& progress, const CancelToken& cancel,
         bool again)
      : db_(db),
        indexFolder_(indexFolder),
        progress_(progress),
        cancel_(cancel),
        again_(again),
        writer_(db) {}

  Result<ImportReport> run(const std::vector<ImportRoot>& roots);

 private:
  /// The index's record of a file.
  struct Known {
    std::int64_t id = 0, series = 0, study = 0, folderDevice = 0;
    FileState state;
    std::string reason, program;  // why a file was refused or a series lacks it, and the program that said so
    bool noImage = false, forgotten = false, seen = false;
    std::string folder;
  };

  struct Compared {
    std::vector<FileOnDisk> toRead;
    std::vector<std::pair<std::int64_t, FileOnDisk>> moved;  // number of the indexed file, and its new place
    std::set<std::int64_t> comeBack;                         // forgotten studies with files that exist
  };

  Status importBelow(const ImportRoot& root);
  void learn(const std::string& root);
  Compared compare(const std::vector<FileOnDisk>& files);
  std::int64_t movedFrom(const FileOnDisk& file);
  Status writeCompared(const Compared& compared);
  Status readNew(const std::vector<FileOnDisk>& files);
  Status readBatch(const std::vector<FileOnDisk>& files, std::size_t done, std::size_t total);
  void count(const std::vector<FileOnDisk>& batch, const ReadFiles& read);
  Status writeUnreadable(const FilesBelow& below);
  Status writeGone();
  Status readStale();
  Status readInstitutions();
  std::optional<std::string> institutionOf(std::int64_t study);
  std::optional<FileOnDisk> oneFileOf(std::int64_t series);
  Status writeInstitutions(const std::vector<std::pair<std::int64_t, std::string>>& ofStudies);
  std::vector<FileOnDisk> filesOf(std::int64_t series);
  Status purge();

  Database& db_;
  const std::string& indexFolder_;
  const Progress& progress_;
  const CancelToken& cancel_;
  bool again_;
  Writer writer_;
  ImportReport report_;
  std::unordered_map<std::string, Known> known_;  // files below the current root
};

}  // namespace volumen
