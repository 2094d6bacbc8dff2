#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "ui/controller/study_source.h"
#include "ui/document/job_lane.h"

namespace volumen {

struct Archive;
class ArchiveSource;

using StudySourceList = std::vector<std::unique_ptr<StudySource>>;
/// Makes the sources that are no archives, in their order. `indexFolder` is the folder of the index.
using MakeStudySources = std::function<StudySourceList(const std::string& indexFolder, Jobs& jobs)>;

/// Makes all such sources of this program.
StudySourceList makeStudySources(const std::string& indexFolder, Jobs& jobs);

/// The sources of studies; one of them is listed. The archives of the user's list follow those that are
/// always offered, and before sources that list all others. Each name of an archive has one source, which is
/// kept after the archive left the list, as its studies may be open.
class StudySources : public QObject {
  Q_OBJECT
 public:
  /// `always` has at least one source; the first is listed. Archives fetch into the index in `indexFolder`.
  StudySources(StudySourceList always, std::string indexFolder, Jobs& jobs);

  /// Returns all sources, those that are no longer offered, too. New ones are appended.
  const StudySourceList& all() const { return all_; }
  /// Returns the sources that can be chosen, in the order in which they are offered.
  const std::vector<StudySource*>& offered() const { return offered_; }
  /// Returns the offered source with this key, or null.
  StudySource* offered(const QString& key) const;
  /// Returns the listed source.
  StudySource& current() const { return *current_; }
  /// Returns the first source that supports imports, or null.
  StudySource* importer() const;
  /// Lists source `n` of offered().
  void choose(std::size_t n);
  /// Offers the archives of the user's list as it is now. Lists the first source if the listed one is gone.
  /// The Error: the list cannot be read, and the offer stays.
  Status offerArchives();

  /// Returns whether a study that was fetched from an archive is kept when room is short; nothing for others.
  std::optional<bool> isKept(const std::string& studyUid) const;
  /// Keeps such a study or lets it go. Emits failed() if that is not possible.
  void keep(const std::string& studyUid, bool isKept);

 Q_SIGNALS:
  /// Another source is listed.
  void chosen();
  /// Source `number` of all() was made.
  void added(std::size_t number);
  void offeredChanged();
  /// A sentence why a study is not kept.
  void failed(const QString& sentence);

 private:
  ArchiveSource& sourceOf(const Archive& archive);
  void offer(const std::vector<Archive>& archives);

  const std::string indexFolder_;
  Jobs& jobs_;
  StudySourceList all_;
  const std::size_t always_;                        // number of sources that are no archives
  std::map<std::string, ArchiveSource*> archives_;  // by name
  std::vector<StudySource*> offered_;
  StudySource* current_;
  JobLane marks_;
};

}  // namespace volumen
