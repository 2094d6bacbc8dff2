#pragma once

#include <QMenu>

namespace volumen {

/// Entries that a menu lists before its fixed ones, with a separator between them.
class ListedEntries {
 public:
  /// Shows `entries`, which belong to `menu`, in place of those of the last call, and deletes the latter.
  void show(QMenu& menu, const QList<QAction*>& entries) {
    qDeleteAll(shown_);
    QAction* fixed = menu.actions().value(0);
    menu.insertActions(fixed, entries);
    shown_ = entries;
    shown_ << menu.insertSeparator(fixed);
  }

 private:
  QList<QAction*> shown_;  // with the separator
};

}  // namespace volumen
