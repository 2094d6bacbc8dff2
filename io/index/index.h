#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/unread.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct ImportRoot;
struct OpenedDatabase;

/// A series in the index. Images that are not volumes count, too.
struct IndexedSeries {
  std::int64_t id = 0;  ///< in the index
  std::string seriesUid, number, modality, description, date, time;
  std::string label;                  ///< how its volumes differ ("4 echoes", "451 directions"); may be empty
  int images = 0;                     ///< number of files
  int frames = 0;                     ///< number of slices and frames
  bool isVolume = false;              ///< contains at least one volume
  bool offline = false;               ///< files are not available (a removed disk, a moved folder)
  std::vector<std::string> warnings;  ///< sentences on its volumes and on refused files
  bool operator==(const IndexedSeries&) const = default;
};

/// A study in the index with its patient. Studies of one PatientID and name belong to one patient.
struct IndexedStudy {
  std::int64_t id = 0;  ///< in the index
  std::string patientName, patientId, birthDate, sex;
  std::string studyUid, date, time, description, accessionNumber;
  std::string institution;  ///< empty if an older program imported the study
  std::string modalities;   ///< "CT, PT": of its series, sorted
  int series = 0, images = 0;
  int warnings = 0;        ///< number of warnings of its series
  bool offline = false;    ///< true if none of its files is available
  std::string importedAt;  ///< ISO 8601, UTC
  std::string openedAt;    ///< last time, ISO 8601, UTC; empty: never
  bool operator==(const IndexedStudy&) const = default;
};

enum class StudyOrder { date, patient, modality, imported, opened };

/// Query for `studies`: each word of `words` must occur in name, ID, date, accession number, institution,
/// modality or a description. Case and accents are ignored, in any script; "today" and "yesterday" are dates.
struct StudyQuery {
  std::string words;  ///< words as typed; if empty, all studies match
  StudyOrder order = StudyOrder::date;
  bool ascending = false;
  int limit = 0;  ///< 0: all
};

/// Result of an import. Each file is added, changed, unchanged, not an image, or refused.
struct ImportReport {
  int files = 0;      ///< found, including unreadable entries
  int added = 0;      ///< new instances
  int changed = 0;    ///< read again because they differ from the index
  int unchanged = 0;  ///< files not read again
  int notImages = 0;  ///< files in no series
  int gone = 0;       ///< known below the path, but deleted
  std::vector<Refused> refused;
  std::vector<Refused> lacking;    ///< among `notImages`: files that series may lack
  std::vector<std::string> empty;  ///< paths without files
  bool cancelled = false;          ///< finished work is kept; the next import continues
};

/// Progress text at the end of an import, which counts studies instead of files: the institutions of studies
/// from an older program are read.
inline constexpr const char* readingInstitutions = "reading institutions";

/// A thumbnail of a series for lists, PNG bytes; empty: none.
using Thumbnail = std::vector<std::uint8_t>;

/// The index of studies on this machine: a database (SQLite) that can be rebuilt from the files at any time.
/// Files stay where they are. Several threads and programs may use one folder at once; each thread opens its
/// own Index.
class Index {
 public:
  /// Opens the index in `folder`, creates it if there is none, and updates an older schema. A damaged or
  /// newer one is renamed and replaced, which `notice()` reports. The Error: the folder cannot be written, or
  /// its name is empty, as that of a user without a home.
  static Result<Index> open(const std::string& folder);
  /// Opens the index in `folder` for queries, even if it cannot be written. Creates and renames nothing. The
  /// Error: there is none, it is damaged, or of a newer program.
  static Result<Index> openAsItIs(const std::string& folder);
  Index(Index&&) noexcept;
  ~Index();

  /// Returns a sentence about damage found at opening or during an import; empty if there is none.
  const std::string& notice() const;

  /// Reads everything below each of `paths` into the index, by reference. Deleted files of a folder leave the
  /// index. With `again`, refused files are read again.
  Result<ImportReport> import(const std::vector<std::string>& paths, const Progress& progress = {},
                              const CancelToken& cancel = {}, bool again = false);
  /// Copies the files to `managedFolder`/PATIENT/STUDY/SERIES/ and imports the copies.
  Result<ImportReport> importCopies(const std::vector<std::string>& paths, const std::string& managedFolder,
                                    const Progress& progress = {}, const CancelToken& cancel = {});

  Result<std::vector<IndexedStudy>> studies(const StudyQuery& query = {}) const;
  Result<std::vector<IndexedSeries>> series(std::int64_t study) const;
  /// Returns the files of a study, or of one of its series (0: all), for `openFiles`.
  Result<std::vector<std::string>> files(std::int64_t study, std::int64_t series = 0) const;
  /// Returns refused files in the same folders: they may belong to a series (Series::unread), as `openFiles`
  /// reports.
  Result<std::vector<std::string>> refusedBeside(std::int64_t study, std::int64_t series = 0) const;
  /// Returns the middle slice of a series in its window; made on first use and kept.
  Result<Thumbnail> thumbnail(std::int64_t series);

  /// Records that a study was opened now.
  Status opened(std::int64_t study);
  /// Removes studies from the index, but no files from disk. `undoForget` or a new import restores them;
  /// after a day they are gone for good.
  Status forget(const std::vector<std::int64_t>& studies);
  Status undoForget(const std::vector<std::int64_t>& studies);
  /// Returns the studies that the last `forget` removed and that can be restored.
  Result<std::vector<std::int64_t>> lastForgotten() const;

 private:
  struct Private;
  explicit Index(std::unique_ptr<Private> p);
  static Result<Index> made(const std::string& folder,
                            Result<OpenedDatabase> (*openDatabase)(const std::string& folder));
  Result<ImportReport> importBelow(const std::vector<ImportRoot>& roots, const Progress& progress,
                                   const CancelToken& cancel, bool again);
  std::unique_ptr<Private> p_;
};

/// Opens an index for an import (Index::open(), import()).
Result<ImportReport> importIntoIndex(const std::string& indexFolder, const std::vector<std::string>& paths,
                                     const Progress& progress = {}, const CancelToken& cancel = {});

/// Returns $XDG_DATA_HOME/volumen, else ~/.local/share/volumen; empty if there is no home.
std::string userIndexFolder();

}  // namespace volumen
