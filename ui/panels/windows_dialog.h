#pragma once

#include <QDialog>
#include <QLabel>
#include <QTableWidget>

#include "ui/workspace/session.h"

namespace volumen {

/// Edits the list of the user's own windows: names, numbers and removal. Each change is saved at once.
class WindowsDialog : public QDialog {
  Q_OBJECT
 public:
  /// Returns the window of the slice or frame in focus, without a name, or nothing.
  using InUse = std::function<std::optional<OwnWindow>()>;
  WindowsDialog(Session& session, InUse inUse, QWidget* parent);

 private:
  QWidget* makeButtons();
  void showWindows();
  void add();
  void remove();
  void edit(int row, int column);

  Session& session_;
  const InUse inUse_;
  QTableWidget* table_;
  QLabel* note_;
};

}  // namespace volumen
