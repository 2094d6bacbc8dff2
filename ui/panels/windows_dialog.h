#pragma once

#include <QDialog>
#include <QLabel>
#include <QTableWidget>

#include "ui/workspace/session.h"

namespace volumen {

/// The user's own windows: named, numbered and taken off the list here; each change is kept at once.
class WindowsDialog : public QDialog {
  Q_OBJECT
 public:
  /// The window in use of the slice or frame in focus, without a name; none: there is none.
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
