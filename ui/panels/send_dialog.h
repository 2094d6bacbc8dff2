#pragma once

#include <QComboBox>
#include <QDialog>

#include "io/archive/archives.h"

namespace volumen {

/// Asks which of several images to send, and to which archive.
class SendDialog : public QDialog {
  Q_OBJECT
 public:
  /// `name` tells what the images are of, `choices` which of them can be sent. Proposes the archive `last`,
  /// if there is one of this name.
  SendDialog(const QString& name, const QStringList& choices, const Archives& archives, const QString& last,
             QWidget* parent = nullptr);

  /// Returns the index of the choice.
  int choice() const { return choice_->currentIndex(); }
  /// Returns the index of the archive.
  int archive() const { return archive_->currentIndex(); }

 private:
  QComboBox *choice_, *archive_;
};

}  // namespace volumen
