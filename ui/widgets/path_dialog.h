#pragma once

#include <QFileDialog>

namespace volumen {

/// A question for a file or folder.
struct PathQuestion {
  const char* dialog;  ///< object name
  QString title;
  QString filters = {};
  QString offered = {};                               ///< name of a file to write; its suffix is the default
  QFileDialog::FileMode mode = QFileDialog::AnyFile;  ///< what is chosen if nothing is to be written
  QString folder = {};                                ///< empty: the dialog's own
};

/// Opens a dialog that deletes itself. It reports the choice by its signals.
QFileDialog* openPathDialog(QWidget* parent, const PathQuestion& question);

}  // namespace volumen
