#pragma once

#include <QLabel>
#include <QStackedWidget>

namespace volumen {

/// Shows a panel, or in its place the reason why there is nothing to set.
class Explained : public QStackedWidget {
  Q_OBJECT
 public:
  explicit Explained(QWidget* panel);

  /// Shows the reason, or the panel if it is empty.
  void explain(const QString& sentence);
  /// Returns the displayed reason; empty: the panel is visible.
  QString sentence() const { return currentIndex() == 0 ? QString() : sentence_->text(); }

 private:
  QLabel* sentence_;
};

}  // namespace volumen
