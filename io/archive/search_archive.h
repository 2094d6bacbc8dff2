#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/archive/archives.h"
#include "io/index/index.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A search of an archive.
struct ArchiveQuery {
  std::string words;        ///< as a user types them (search_words.h)
  int limit = 5000;         ///< largest number of studies
  bool withSeries = false;  ///< lists the series of each study, too
};

struct ArchiveStudy {
  IndexedStudy study;                 ///< `id` counts from 1; numbers of series and images are -1 if unknown
  std::vector<IndexedSeries> series;  ///< empty unless asked for
};

struct ArchiveAnswers {
  std::vector<ArchiveStudy> studies;  ///< newest first
  /// Why there may be more: a limit was reached, or the archive ended the search. One sentence; empty if
  /// these are all.
  std::string incomplete;
  bool isBroken = false;  ///< `incomplete` is a failure of the archive, and no limit
};

/// Verifies that an archive answers. The Error says in one sentence what is wrong.
Status testArchive(const Archive& archive, const CancelToken& cancel);

using OnStudy = std::function<void(const IndexedStudy& study)>;

/// Searches an archive. `onStudy` gets each study as it comes, without its number; not those of which the
/// archive does not tell the modality that is searched for. Answers that lack one of the words are left out,
/// as archives may ignore a key.
Result<ArchiveAnswers> searchArchive(const Archive& archive, const ArchiveQuery& query,
                                     const OnStudy& onStudy, const CancelToken& cancel);

/// Returns the studies of a patient, who has both this ID and this name. Those whose modalities the archive
/// does not tell are asked for their series.
Result<std::vector<IndexedStudy>> studiesOfArchivedPatient(const Archive& archive, const std::string& id,
                                                           const std::string& name,
                                                           const CancelToken& cancel);

/// Returns the series of one study of an archive, as far as it lists them.
Result<std::vector<IndexedSeries>> seriesOfArchiveStudy(const Archive& archive, const std::string& studyUid,
                                                        const CancelToken& cancel);

}  // namespace volumen
