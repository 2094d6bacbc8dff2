#pragma once

#include <optional>

#include "ui/document/job_lane.h"
#include "ui/workspace/hand_work.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Tracks the session file of the workspace and whether they differ, and writes the file as a job.
class SessionFiles : public QObject {
  Q_OBJECT
 public:
  SessionFiles(Session& session, Jobs& jobs, QObject* parent = nullptr);
  /// Waits until pending files are written.
  ~SessionFiles() override;

  /// Returns the path, or an empty string if the workspace is in no file.
  const QString& path() const { return path_; }
  /// Returns whether the workspace differs from its file or has none. The focus and closed series do not
  /// count.
  bool modified() const;
  /// Returns manual work, on closed series too, that is in no file written or read.
  HandWork unsavedWork() const { return without(workIn(session_.workspace()), saved_); }

  /// Returns manual work that is in a file written or read, in any of its states.
  const HandWork& savedWork() const { return saved_; }

  /// Reports that this work is in a file of its own.
  void savedApart(const HandWork& work);

  /// Saves the session; ends in saved() or failed().
  void save(const QString& path);
  /// Reports that the workspace was just read from this file.
  void opened(const QString& path);
  /// Reports that the workspace was restored; the file, if any, still holds `saved`.
  void restored(const QString& path, const std::optional<Workspace>& saved);

 Q_SIGNALS:
  void saved(const QString& path);
  void failed(const QString& sentence);
  /// path() or modified() changed.
  void changed();

 private:
  void become(const QString& path, const std::optional<Workspace>& written);
  void set(const QString& path, const std::optional<Workspace>& written);
  void followUndo(int step);
  void countAsSaved(const HandWork& work) { saved_ = saved_ + without(work, saved_); }
  void tellModified();

  Session& session_;
  QString path_;
  std::optional<Workspace> written_;  // content of the file
  HandWork saved_;                    // manual work in any file of this run
  // The file of a workspace that was closed at undo step `step`; undo restores it.
  struct Closed {
    int step;
    QString path;
    std::optional<Workspace> written;
  };
  std::optional<Closed> closed_;
  int openedAt_ = 0;  // undo step from which on the workspace is that file's
  int became_ = 0;    // number of changes of the file other than by saving
  bool modifiedTold_ = false;
  JobLane lane_;
};

}  // namespace volumen
