#pragma once

#include <QDateTime>
#include <QTimer>
#include <memory>
#include <optional>

#include "io/files/lock_file.h"
#include "ui/controller/session_files.h"
#include "ui/workspace/session_json.h"

namespace volumen {

/// Unsaved work of another run of the program, locked so that this run can restore or discard it.
struct LostSession {
  QString path;     ///< of the autosave file
  QString savedAs;  ///< the session file it belongs to; empty if there is none
  QDateTime at;     ///< time of the last autosave
  std::shared_ptr<LockFile> lock;
  std::vector<SavedPatient> patients{};  ///< patients whose pictures it shows
};

/// What happens to the autosave file when the program ends normally.
enum class AtEnd {
  usual,  ///< It is removed unless a session file has unsaved changes.
  keep,   ///< It stays because nobody could be asked.
  aside   ///< It is moved aside because the user discarded it.
};

/// Saves unsaved work to one file per running program in the user's data folder. A worker thread writes it
/// within 2 s of every change; during playback it waits until that rests. The file is removed when everything
/// is saved, and at the end of the program as AtEnd says. Discarded files are kept aside for a week.
class Autosave : public QObject {
  Q_OBJECT
 public:
  Autosave(const Session& session, const SessionFiles& files, QObject* parent = nullptr);
  ~Autosave() override;

  /// Searches on the worker thread for work of other runs and for discarded files. found() reports the latest
  /// of the former, listed() all of the latter.
  void look();
  /// Moves the work aside.
  void discard(const LostSession& lost);
  /// Deletes the work once the workspace has been saved in its place.
  void replace(const LostSession& lost);
  /// Waits until the workspace is saved as it is. The Error says why that failed.
  Status keepNow();
  void setAtEnd(AtEnd atEnd) { atEnd_ = atEnd; }

  /// Returns $XDG_DATA_HOME/volumen/autosave.
  static QString folder();

 Q_SIGNALS:
  void found(const volumen::LostSession& lost);
  /// The files discarded within a week, latest first. They are not locked.
  void listed(const std::vector<volumen::LostSession>& discarded);
  /// A sentence, sent once until writing succeeds again.
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
  std::unique_ptr<File> file_;  // used on the lane's thread
  bool writing_ = false, failing_ = false;
  std::optional<LostSession> replaced_;
  AtEnd atEnd_ = AtEnd::usual;
  JobLane lane_;
};

}  // namespace volumen
