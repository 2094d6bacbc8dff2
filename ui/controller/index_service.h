#pragma once

#include <optional>

#include "ui/controller/study_source.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// The index of studies. One thread answers queries in order, one makes thumbnails, one imports. Each import
/// is a job in the list.
class IndexService : public StudySource {
  Q_OBJECT
 public:
  /// `folder` holds the index, which is opened or created when first needed.
  IndexService(const std::string& folder, Jobs& jobs, QObject* parent = nullptr);
  /// Cancels pending work; what has been imported is kept.
  ~IndexService() override;

  QString key() const override { return QStringLiteral("index"); }
  QString name() const override { return tr("This computer"); }

  void list(const StudyListRequest& request) override;
  void series(std::int64_t study) override;
  void studiesOf(const std::string& patientId, const std::string& patientName) override;
  void wantThumbnails(const std::vector<std::int64_t>& series) override;
  /// Also records that the study was opened, unless it is only looked into.
  void open(const IndexedChoice& choice, OpenHow how) override;
  ListFiles filesOf(const IndexedChoice& choice) const override;
  bool canImport() const override { return true; }
  void import(const QStringList& paths) override;
  bool canRemove() const override { return true; }
  void remove(const std::vector<std::int64_t>& studies) override;
  void undoRemove(const std::vector<std::int64_t>& studies) override;

 private:
  // A thread and its connection to the index.
  struct Worker {
    std::optional<Index> index;
    JobLane lane;
  };

  template <class Work, class Done, class Failed>
  int start(Worker& worker, Work work, Done done, Failed refuse);
  template <class Work, class Done>
  int start(Worker& worker, Work work, Done done);
  Index* indexOf(Worker& worker);
  Progress importProgress(const Job& import, const Job& job);
  void change(const std::vector<std::int64_t>& studies,
              Status (Index::*how)(const std::vector<std::int64_t>& studies));

  const std::string folder_;
  Jobs& jobs_;
  int listing_ = 0;                 // number of the job
  std::vector<int> thumbnailJobs_;  // in order of the requests
  std::vector<Job> imports_;        // in the job list; a cancelled import keeps what it has imported
  Worker queries_, thumbnails_{{}, JobLane(nullptr, QThread::LowPriority)},
      importer_{{}, JobLane(nullptr, QThread::LowPriority)};
};

}  // namespace volumen
