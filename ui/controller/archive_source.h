#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "io/archive/archives.h"
#include "io/archive/fetch_archive.h"
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

/// An archive of the user's list. Without words it lists the studies of today. It lists what it answers while
/// answers come. Opened studies are fetched into the folder of the index, and imported while they are opened.
/// Searches and fetches are jobs in the list. A search that is cancelled there or fails ends in unavailable()
/// if it found nothing, else in what it found.
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
  /// Instances that were fetched before are not fetched again. A study comes series by series, unless it is
  /// shown as a whole: a PET over its CT, X-ray pictures that hang together, or a study that is looked into.
  void open(const IndexedChoice& choice, OpenHow how) override;

 Q_SIGNALS:
  /// Fetched files were imported into the index.
  void imported();

 private:
  // Images on this computer, by UID of their study.
  using ImagesHere = std::shared_ptr<const std::map<std::string, int>>;
  using StudiesPtr = std::shared_ptr<const std::vector<IndexedStudy>>;
  // Studies that came while an archive is searched, and were not listed yet.
  struct Incoming {
    std::mutex mutex;
    std::vector<IndexedStudy> studies;
    ImagesHere here;
  };
  // What is known of the answer to the last search.
  struct Answer {
    std::string words;
    std::vector<StudiesPtr> studies;  // as they were taken, many at once
    std::size_t count = 0;
    ImagesHere here;
    QString notice;
    bool isWhole = false;
  };
  // What is known of the images of a fetch.
  struct Arrival {
    FetchRequest request;
    std::shared_ptr<std::atomic<int>> came;
    int seen = 0;  // images at the last look
  };
  struct Found;
  struct Opening;
  struct Fetched;

  // Empty without an index.
  static ImagesHere imagesHere(const std::string& indexFolder);
  static StudyList listOf(const Answer& answer, const StudySort& sort);
  Result<Found> find(const Archive& archive, const std::string& words, Incoming& incoming,
                     const Job& job) const;
  Result<Fetched> fetch(const Opening& opening, const Job& job);
  void take(const Opening& opening, const Fetched& fetched);
  void followArrival(const Opening& opening);
  void lookAtArrival();
  void endArrival(const Opening& opening);
  void endArrival();
  std::vector<IndexedStudy> numbered(std::vector<IndexedStudy> studies);
  void search(const std::string& words);
  void giveUpSearch();
  void takeIncoming();
  void takeAnswer(const std::string& words, Found found);
  void tellAnswer();
  void endSearch(const QString& sentence);
  void importInto(const std::string& folder);
  void takeSeries(std::int64_t study, std::vector<IndexedSeries> found);

  Archive archive_;  // jobs use copies
  const std::string indexFolder_;
  UidNumbers studies_, series_;
  std::map<std::int64_t, std::string> patientNames_;  // by study
  std::map<std::int64_t, SeriesListPtr> seriesOf_;    // by study, since the last search
  std::map<std::string, std::map<std::string, std::vector<std::string>>> opened_;  // files by study, series
  StudyListRequest wanted_;
  std::optional<Answer> answer_;  // empty after a failure
  bool isListOld_ = false;        // the list in work lacks what came since
  std::shared_ptr<Incoming> incoming_;
  ImagesHere newestHere_;           // if something was imported since the search began
  std::optional<Arrival> arrival_;  // of the fetch begun last, until what it shows first is here
  QTimer look_, lookAtArrival_;
  QElapsedTimer sinceTaken_;
  JobLane searches_, lists_, questions_, fetches_, seriesFetches_, arrivals_, imports_;
};

}  // namespace volumen
