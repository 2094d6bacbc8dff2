#pragma once

#include <optional>

#include "ui/document/job_lane.h"
#include "ui/workspace/hand_work.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Which session file the workspace is in, and whether it holds something else by now; writes it as a job.
class SessionFiles : public QObject {
  Q_OBJECT
 public:
  SessionFiles(Session& session, Jobs& jobs, QObject* parent = nullptr);
  /// Waits for what is being written.
  ~SessionFiles() override;

  /// Empty: it is in none.
  const QString& path() const { return path_; }
  /// Whether the workspace is not, or not as it is, in a file. The focus and what is closed count for
  /// nothing.
  bool modified() const;
  /// What was made by hand, on closed series, too, and is in no file that was written or read.
  HandWork unsavedWork() const { return without(workIn(session_.workspace()), saved_); }

  /// This was written into a file of its own.
  void savedApart(const HandWork& work);

  /// Ends in saved() or failed().
  void save(const QString& path);
  /// The workspace was read from this file just now.
  void opened(const QString& path);
  /// It was restored; the file, if any, holds `saved` as yet.
  void restored(const QString& path, const std::optional<Workspace>& saved);

 Q_SIGNALS:
  void saved(const QString& path);
  void failed(const QString& sentence);
  /// Of path() or modified().
  void changed();

 private:
  void become(const QString& path, const std::optional<Workspace>& written);
  void set(const QString& path, const std::optional<Workspace>& written);
  void followUndo(int step);
  void tellModified();

  Session& session_;
  QString path_;
  std::optional<Workspace> written_;  // what the file holds
  HandWork saved_;                    // what any file of this run holds
  // The file whose workspace was closed by the step from this one on: undo brings it back.
  struct Closed {
    int step;
    QString path;
    std::optional<Workspace> written;
  };
  std::optional<Closed> closed_;
  int openedAt_ = 0;  // the undo step from which on it is that file's
  int became_ = 0;    // how often it became another file's, but by saving
  bool modifiedTold_ = false;
  JobLane lane_;
};

}  // namespace volumen
