#pragma once

#include <optional>

#include "ui/controller/study_source.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// The index of studies on threads of its own: one that answers in order, one that makes thumbnails, one that
/// imports; each import is a job of the list.
class IndexService : public StudySource {
  Q_OBJECT
 public:
  /// `folder`: of the index; it is opened, or made, when it is first needed.
  IndexService(const std::string& folder, Jobs& jobs, QObject* parent = nullptr);
  /// Gives up what is under way; what was imported until then is kept.
  ~IndexService() override;

  QString key() const override { return QStringLiteral("index"); }
  QString name() const override { return tr("This computer"); }

  void list(const StudyListRequest& request) override;
  void series(std::int64_t study) override;
  void studiesOf(const std::string& patientId, const std::string& patientName) override;
  void wantThumbnails(const std::vector<std::int64_t>& series) override;
  /// Remembers that the study was opened, too, but for what is only looked into.
  void open(const IndexedChoice& choice, OpenHow how) override;
  bool canImport() const override { return true; }
  void import(const QStringList& paths) override;
  bool canRemove() const override { return true; }
  void remove(const std::vector<std::int64_t>& studies) override;
  void undoRemove(const std::vector<std::int64_t>& studies) override;

 private:
  // A thread, and the index as it has it open.
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
  int listing_ = 0;                 // job
  std::vector<int> thumbnailJobs_;  // in the order in which they were wanted
  std::vector<Job> imports_;        // in the list; each ends with what was imported until it was cancelled
  Worker queries_, thumbnails_{{}, JobLane(nullptr, QThread::LowPriority)},
      importer_{{}, JobLane(nullptr, QThread::LowPriority)};
};

}  // namespace volumen
