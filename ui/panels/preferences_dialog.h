#pragma once

#include <QDialog>

#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"

class QFormLayout;

namespace volumen {

/// Edit > Preferences. Every choice takes effect at once.
class PreferencesDialog : public QDialog {
  Q_OBJECT
 public:
  /// Archives are tested on `tests`, which outlives the dialog.
  PreferencesDialog(Session& session, JobLane& tests, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// The user's list of archives was written.
  void archivesSaved();

 private:
  void addFields(QFormLayout& form);
  void askToRestore();

  Session& session_;
  JobLane& tests_;
};

}  // namespace volumen
