#include "ui/controller/session_files.h"

#include "ui/controller/open_session.h"

namespace volumen {

SessionFiles::SessionFiles(Session& session, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), lane_(&jobs) {
  lane_.keepToTheEnd();
  connect(&session_.undoStack(), &QUndoStack::indexChanged, this, &SessionFiles::followUndo);
  connect(&session_, &Session::workspaceChanged, this, [this](const Workspace&, const Workspace& after) {
    if (after.series.empty() && !path_.isEmpty()) {
      closed_ = Closed{session_.undoStack().index(), path_, written_};
      return become({}, {});
    }
    if (modified() != modifiedTold_) tellModified();
  });
}

SessionFiles::~SessionFiles() { lane_.wait(); }

bool SessionFiles::modified() const {
  if (!written_) return !session_.workspace().series.empty();
  if (session_.workspace() == *written_) return false;
  Workspace now = withFocusOf(session_.workspace(), *written_);
  now.closed = written_->closed;
  now.unlisted = written_->unlisted;
  return now != *written_;
}

void SessionFiles::become(const QString& path, const std::optional<Workspace>& written) {
  ++became_;
  set(path, written);
}

void SessionFiles::set(const QString& path, const std::optional<Workspace>& written) {
  path_ = path;
  written_ = written;
  if (written) {
    Workspace inFile = *written;
    inFile.closed.clear();
    countAsSaved(workIn(inFile));
  }
  tellModified();
}

void SessionFiles::savedApart(const HandWork& work) {
  if (work.empty()) return;
  countAsSaved(work);
  tellModified();
}

void SessionFiles::tellModified() {
  modifiedTold_ = modified();
  Q_EMIT changed();
}

// Before the step that opened it the workspace was another one, which must not overwrite the file.
void SessionFiles::followUndo(int step) {
  if (closed_ && step <= closed_->step) {
    const Closed closed = *std::exchange(closed_, {});
    if (step == closed.step) become(closed.path, closed.written);
  }
  if (step >= openedAt_) return;
  // A step that cancelled itself was removed without an undo.
  const bool isUndone = session_.undoStack().canRedo();
  openedAt_ = isUndone ? 0 : step;
  if (isUndone) become({}, {});
}

void SessionFiles::opened(const QString& path) {
  openedAt_ = session_.undoStack().index();
  become(path, session_.workspace());
}

void SessionFiles::restored(const QString& path, const std::optional<Workspace>& saved) {
  openedAt_ = session_.undoStack().index();
  become(path, saved);
}

void SessionFiles::save(const QString& path) {
  const Workspace workspace = session_.workspace();
  lane_.run(
      tr("Saving the session"),
      [path, workspace](const Job&) { return saveSession(path.toStdString(), workspace); },
      [this, path, workspace, became = became_](const Status& status) {
        if (!status) return void(Q_EMIT failed(QString::fromStdString(status.message())));
        if (became == became_) set(path, workspace);
        Q_EMIT saved(path);
      });
}

}  // namespace volumen
