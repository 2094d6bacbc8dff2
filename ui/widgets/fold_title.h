#pragma once

#include <QDockWidget>
#include <QToolButton>

namespace volumen {

/// The title of a panel: a click on it, or Space, folds the panel to its title and back. Tabs of one dock
/// area fold together.
class FoldTitle : public QWidget {
  Q_OBJECT
 public:
  /// Becomes the title of `dock`.
  explicit FoldTitle(QDockWidget* dock);

  bool folded() const { return folded_; }
  void setFolded(bool folded);

 protected:
  void mousePressEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void mouseDoubleClickEvent(QMouseEvent*) override {}
  void changeEvent(QEvent*) override;

 private:
  void foldWithTabs(bool folded);

  QDockWidget* dock_;
  QToolButton* arrow_;
  QPoint pressedAt_;
  bool folded_ = false;
  QList<int> heightsBefore_;  // heights of the panels in its column before folding
};

}  // namespace volumen
