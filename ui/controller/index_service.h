#pragma once

#include <QImage>
#include <QStringList>
#include <functional>
#include <optional>
#include <vector>

#include "io/index/index.h"
#include "ui/controller/open_intent.h"
#include "ui/data/study_list.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// What the study browser wants to list.
struct StudyListRequest {
  std::string words;  ///< as typed; empty: all studies, and those opened last
  StudySort sort;
};

/// The index of studies on threads of its own: one that answers in order, one that makes thumbnails, one that
/// imports; each import is a job of the list. Asking never waits.
class IndexService : public QObject {
  Q_OBJECT
 public:
  /// `folder`: of the index; it is opened, or made, when it is first needed.
  IndexService(const std::string& folder, Jobs& jobs, QObject* parent = nullptr);
  /// Gives up what is under way; what was imported until then is kept.
  ~IndexService() override;

  /// Ends in listed(), or in unavailable() where the index cannot be opened; the newest request alone is
  /// answered.
  void list(const StudyListRequest& request);
  /// Ends in seriesListed().
  void series(std::int64_t study);
  /// Ends in thumbnailMade() for each; those wanted before and not begun are given up.
  void wantThumbnails(const std::vector<std::int64_t>& series);
  /// Ends in filesFound(); remembers that the study was opened.
  void open(const IndexedChoice& choice, OpenHow how);
  /// Takes studies out of the index, and back into it; never deletes files. Ends in changed().
  void remove(const std::vector<std::int64_t>& studies);
  void undoRemove(const std::vector<std::int64_t>& studies);
  /// Reads all below these paths into the index, after what is being imported already. Ends in importEnded().
  void import(const QStringList& paths);

 Q_SIGNALS:
  void listed(const volumen::StudyListPtr& list);
  void seriesListed(qint64 study, const volumen::SeriesListPtr& series);
  /// Null: there is none.
  void thumbnailMade(qint64 series, const QImage& thumbnail);
  /// The files of the study of a choice, and what was asked for, with the series of the choice.
  void filesFound(const volumen::IndexedChoice& choice, const std::vector<std::string>& files,
                  const volumen::OpenIntent& intent);
  /// The index holds something else now.
  void changed();
  void importBegun();
  void importEnded(const volumen::ImportReport& report);
  /// A sentence on what was asked last.
  void failed(const QString& sentence);
  /// Why there is no index.
  void unavailable(const QString& sentence);
  /// What is to be known of the index, told once: a damaged one was put aside.
  void noticed(const QString& sentence);

 private:
  // A thread, and the index as it has it open.
  struct Worker {
    std::optional<Index> index;
    JobLane lane;
  };

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
