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

/// One import into the index: looks at what is below paths, reads what is new or was changed, and notes what
/// is gone. What is read is written batch by batch, so that it can be stopped at any moment; series that were
/// written in parts are marked, and read as a whole in the end (or by the next import).
class Import {
 public:
  /// `indexFolder`: the one of the index, whose own files are passed over. `again`: files that were refused
  /// are read again.
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
  /// What the index knows of a file.
  struct Known {
    std::int64_t id = 0, series = 0, study = 0, folderDevice = 0;
    FileState state;
    std::string reason, program;  // of a refusal, or of what a series lacks
    bool noImage = false, forgotten = false, seen = false;
    std::string folder;
  };

  struct Compared {
    std::vector<FileOnDisk> toRead;
    std::vector<std::pair<std::int64_t, FileOnDisk>> moved;  // with the file's number
    std::set<std::int64_t> comeBack;                         // forgotten studies whose files are there
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
  std::unordered_map<std::string, Known> known_;  // below the root that is being imported
};

}  // namespace volumen
