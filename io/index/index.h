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

/// A series of the index. Pictures that are no volume count, too.
struct IndexedSeries {
  std::int64_t id = 0;  ///< in the index
  std::string seriesUid, number, modality, description, date, time;
  std::string label;  ///< what tells it from others of its name ("4 echoes", "451 directions"); may be empty
  int images = 0;     ///< files
  int frames = 0;     ///< slices and frames in them
  bool isVolume = false;              ///< something of it is a volume
  bool offline = false;               ///< its files are not there now (a removed disk, a moved folder)
  std::vector<std::string> warnings;  ///< sentences, of its volumes and of files refused
  bool operator==(const IndexedSeries&) const = default;
};

/// A study of the index, with whose it is. Studies of one PatientID and name belong to one patient.
struct IndexedStudy {
  std::int64_t id = 0;  ///< in the index
  std::string patientName, patientId, birthDate, sex;
  std::string studyUid, date, time, description, accessionNumber;
  std::string institution;  ///< where it was made; not known of what an older program imported before
  std::string modalities;   ///< "CT, PT": of its series, sorted
  int series = 0, images = 0;
  int warnings = 0;        ///< of its series
  bool offline = false;    ///< none of its files is there now
  std::string importedAt;  ///< ISO 8601, UTC
  std::string openedAt;    ///< the last time, ISO 8601, UTC; empty: never
  bool operator==(const IndexedStudy&) const = default;
};

enum class StudyOrder { date, patient, modality, imported, opened };

/// What `studies` gives: those that have every word of `words` in name, ID, date, accession number,
/// institution, modality or a description, in any script, without regard to case and accents.
struct StudyQuery {
  std::string words;  ///< as typed; empty: all
  StudyOrder order = StudyOrder::date;
  bool ascending = false;
  int limit = 0;  ///< 0: all
};

/// How an import went. Each file is added, changed, unchanged, no image or refused.
struct ImportReport {
  int files = 0;      ///< found, and what could not be looked at
  int added = 0;      ///< instances that are new
  int changed = 0;    ///< read again: they were others than the index knew
  int unchanged = 0;  ///< not read again
  int notImages = 0;  ///< in no series
  int gone = 0;       ///< known below the path, and no longer there
  std::vector<Refused> refused;
  std::vector<Refused> lacking;    ///< among `notImages`: what series may lack
  std::vector<std::string> empty;  ///< of the paths those where no file was found
  bool cancelled = false;          ///< what was done until then is kept; the next import goes on from there
};

/// What the progress of an import says in its end, when studies are counted and not files: where those were
/// made that an older program imported is read.
inline constexpr const char* readingInstitutions = "reading institutions";

/// A picture of a series for lists: PNG bytes; empty: there is none.
using Thumbnail = std::vector<std::uint8_t>;

/// The index of studies on this machine: a database (SQLite) that can be rebuilt from the files at any time.
/// Files stay where they are. Several threads and several programs may use one folder at once; each thread
/// that reads or writes opens its own Index.
class Index {
 public:
  /// Opens the index in `folder`, makes it where there is none, and brings an older schema up to date. One
  /// that is damaged or of a newer program is renamed aside, and a new one is made: `notice()` says so. An
  /// Error where the folder cannot be written.
  static Result<Index> open(const std::string& folder);
  /// Opens the index that is in `folder` to ask it, also where it cannot be written: nothing is made or
  /// renamed. An Error where there is none, and where it is damaged or of a newer program.
  static Result<Index> openAsItIs(const std::string& folder);
  Index(Index&&) noexcept;
  ~Index();

  /// Returns a sentence about damage found at opening or during an import; empty if there is none.
  const std::string& notice() const;

  /// Reads all below each of `paths` into the index, by reference; a folder's files that are gone leave it.
  /// `again`: also files that were refused before.
  Result<ImportReport> import(const std::vector<std::string>& paths, const Progress& progress = {},
                              const CancelToken& cancel = {}, bool again = false);
  /// The same after copying them to `managedFolder`/PATIENT/STUDY/SERIES/.
  Result<ImportReport> importCopies(const std::vector<std::string>& paths, const std::string& managedFolder,
                                    const Progress& progress = {}, const CancelToken& cancel = {});

  Result<std::vector<IndexedStudy>> studies(const StudyQuery& query = {}) const;
  Result<std::vector<IndexedSeries>> series(std::int64_t study) const;
  /// The files of a study, or of one of its series (0: all), that `openFiles` opens.
  Result<std::vector<std::string>> files(std::int64_t study, std::int64_t series = 0) const;
  /// What beside them could not be read: it may be of them (Series::unread), and `openFiles` says so.
  Result<std::vector<std::string>> refusedBeside(std::int64_t study, std::int64_t series = 0) const;
  /// Of the middle slice of a series by its window; made on first demand and kept.
  Result<Thumbnail> thumbnail(std::int64_t series);

  /// Remembers that a study was opened now.
  Status opened(std::int64_t study);
  /// Takes studies out of the index, never files from their places: until `undoForget`, or until their files
  /// are imported again. For good after a day.
  Status forget(const std::vector<std::int64_t>& studies);
  Status undoForget(const std::vector<std::int64_t>& studies);
  /// The studies that the last `forget` took out and that can still come back.
  Result<std::vector<std::int64_t>> lastForgotten() const;

 private:
  struct Private;
  explicit Index(std::unique_ptr<Private> p);
  static Result<Index> made(const std::string& folder, Result<OpenedDatabase> opened);
  Result<ImportReport> importBelow(const std::vector<ImportRoot>& roots, const Progress& progress,
                                   const CancelToken& cancel, bool again);
  std::unique_ptr<Private> p_;
};

/// $XDG_DATA_HOME/volumen, else ~/.local/share/volumen; empty where there is no home.
std::string userIndexFolder();

}  // namespace volumen
