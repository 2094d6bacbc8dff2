#pragma once

#include <QDateTime>
#include <QTimer>
#include <memory>
#include <optional>

#include "io/files/lock_file.h"
#include "ui/controller/session_files.h"
#include "ui/workspace/session_json.h"

namespace volumen {

/// What another run of the program left unsaved, held for this one to restore or discard.
struct LostSession {
  QString path;     ///< of what was kept on the way
  QString savedAs;  ///< the session file that it belongs to; empty: none
  QDateTime at;     ///< when it was kept last
  std::shared_ptr<LockFile> lock;
  std::vector<SavedPatient> patients{};  ///< whose pictures it shows
};

/// What becomes of what is not saved when the program ends in order.
enum class AtEnd {
  usual,  ///< it goes; changes of a session file stay
  keep,   ///< it stays: nobody could be asked
  aside   ///< it goes aside: nobody wanted it
};

/// Keeps what is not saved: one file a running program in the user's data folder, written on a worker thread
/// within 2 s of every change; where something is played, once that rests. It goes when all is saved, and
/// when the program ends as AtEnd says. What is discarded lies aside for a week.
class Autosave : public QObject {
  Q_OBJECT
 public:
  Autosave(const Session& session, const SessionFiles& files, QObject* parent = nullptr);
  ~Autosave() override;

  /// Looks on the worker thread for what other runs left, and for what lies aside; the latest of the first is
  /// told by found(), all of the second by listed().
  void look();
  /// Puts it aside.
  void discard(const LostSession& lost);
  /// Deletes it once the workspace is kept instead.
  void replace(const LostSession& lost);
  /// Waits until the workspace is kept as it is. The Error: why it cannot be.
  Status keepNow();
  void setAtEnd(AtEnd atEnd) { atEnd_ = atEnd; }

  /// $XDG_DATA_HOME/volumen/autosave.
  static QString folder();

 Q_SIGNALS:
  void found(const volumen::LostSession& lost);
  /// What was discarded within a week, the latest first; nobody holds it.
  void listed(const std::vector<volumen::LostSession>& discarded);
  /// A sentence; once until it could be written again.
  void failed(const QString& sentence);

 private:
  class File;
  void list();
  void noteChange();
  void write();
  void written(const Status& status);
  bool wanted() const;

  const Session& session_;
  const SessionFiles& files_;
  QTimer timer_, played_;
  std::unique_ptr<File> file_;  // for the lane's thread
  bool writing_ = false, failing_ = false;
  std::optional<LostSession> replaced_;
  AtEnd atEnd_ = AtEnd::usual;
  JobLane lane_;
};

}  // namespace volumen
