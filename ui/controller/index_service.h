#pragma once

#include <QImage>
#include <QObject>
#include <QStringList>
#include <QThreadPool>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "io/index/index.h"
#include "ui/controller/open_intent.h"
#include "ui/data/study_list.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What the study browser wants to list.
struct StudyListRequest {
  std::string words;  ///< as typed; empty: all studies, and those opened last
  StudySort sort;
};

/// The index of studies on threads of its own: one that answers in order, one that makes thumbnails, one that
/// imports. Asking never waits.
class IndexService : public QObject {
  Q_OBJECT
 public:
  /// `folder`: of the index; it is opened, or made, when it is first needed.
  explicit IndexService(const std::string& folder, QObject* parent = nullptr);
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
  /// Gives up all imports.
  void cancelImport();

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
  /// Whether anything is being imported.
  void importingChanged(bool importing);
  /// total 0: not known.
  void importProgressed(qint64 done, qint64 total);
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
    QThreadPool pool;
    std::optional<Index> index;
  };
  using Job = std::function<void(Index& index)>;

  void start(Worker& worker, Job job);
  Index* indexOf(Worker& worker);
  void runImport(Index& index, const std::vector<std::string>& paths, const CancelToken& cancel);
  void makeNextThumbnail(Index& index);
  void failWith(const std::string& sentence);
  void change(const std::vector<std::int64_t>& studies,
              Status (Index::*how)(const std::vector<std::int64_t>& studies));
  template <class Function>
  void tell(Function function);

  const std::string folder_;
  Worker queries_, thumbnails_, importer_;
  std::atomic<int> newest_ = 0;  // of the requests to list
  std::atomic<bool> closing_ = false;
  CancelToken cancelImport_;
  int imports_ = 0;
  std::mutex mutex_;                  // guards what follows
  std::vector<std::int64_t> wanted_;  // series whose thumbnails are to be made, the next one last
};

}  // namespace volumen
