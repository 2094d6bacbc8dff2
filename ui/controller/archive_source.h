#pragma once

#include <map>
#include <optional>
#include <set>

#include "io/archive/archives.h"
#include "ui/controller/study_source.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// Numbers UIDs from 1 in the order in which they are first seen. A UID keeps its number.
class UidNumbers {
 public:
  std::int64_t of(const std::string& uid);
  /// Returns an empty text for a number that was not given.
  std::string uidOf(std::int64_t number) const;

 private:
  std::map<std::string, std::int64_t> numbers_;
  std::vector<std::string> uids_;
};

/// An archive of the user's list. Without words it lists the studies of today. Opened studies are fetched
/// into the folder of the index and imported. Searches and fetches are jobs in the list; a search cancelled
/// there ends in unavailable().
class ArchiveSource : public StudySource {
  Q_OBJECT
 public:
  ArchiveSource(Archive archive, std::string indexFolder, Jobs& jobs, QObject* parent = nullptr);

  /// Asks under other settings from now on; studies and series keep their numbers. Emits changed() if the
  /// settings differ.
  void setArchive(Archive archive);

  QString key() const override { return QStringLiteral("archive:") + name(); }
  QString name() const override { return QString::fromStdString(archive_.name); }
  bool isRemote() const override { return true; }

  void list(const StudyListRequest& request) override;
  void series(std::int64_t study) override;
  void studiesOf(const std::string& patientId, const std::string& patientName) override;
  /// Instances that were fetched before are not fetched again.
  void open(const IndexedChoice& choice, OpenHow how) override;

 Q_SIGNALS:
  /// Fetched files were imported into the index.
  void imported();

 private:
  // The answer to the last search.
  struct Answer {
    std::string words;
    std::vector<IndexedStudy> studies;
    std::map<std::int64_t, int> here;  // images on this computer, by study
    QString notice;
  };
  struct Found;
  struct Fetched;

  Result<Found> find(const Archive& archive, const std::string& words, const Job& job) const;
  Result<Fetched> fetch(const Archive& archive, const std::string& studyUid, const std::string& seriesUid,
                        const Job& job);
  std::vector<IndexedStudy> numbered(std::vector<IndexedStudy> studies);
  void takeAnswer(const std::string& words, Found found);
  void tellAnswer();
  void takeSeries(std::int64_t study, std::vector<IndexedSeries> found);

  Archive archive_;  // jobs use copies
  const std::string indexFolder_;
  UidNumbers studies_, series_;
  std::map<std::int64_t, std::string> patientNames_;     // by study
  std::map<std::int64_t, SeriesListPtr> seriesOf_;       // by study, since the last search
  std::map<std::string, std::set<std::string>> opened_;  // series by study; used by the thread of `fetches_`
  StudyListRequest wanted_;
  std::optional<Answer> answer_;  // empty after a failure
  JobLane searches_, questions_, fetches_;
};

}  // namespace volumen
