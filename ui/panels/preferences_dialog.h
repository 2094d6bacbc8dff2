#pragma once

#include <QDialog>

#include "ui/workspace/session.h"

class QFormLayout;

namespace volumen {

/// Edit > Preferences. Every choice takes effect at once.
class PreferencesDialog : public QDialog {
  Q_OBJECT
 public:
  explicit PreferencesDialog(Session& session, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// The user's list of archives was written.
  void archivesSaved();

 private:
  void addFields(QFormLayout& form);
  void askToRestore();

  Session& session_;
};

}  // namespace volumen
