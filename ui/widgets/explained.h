#pragma once

#include <QLabel>
#include <QStackedWidget>

namespace volumen {

/// A panel, or in its place a sentence that says why there is nothing to set.
class Explained : public QStackedWidget {
  Q_OBJECT
 public:
  explicit Explained(QWidget* panel);

  /// Empty: the panel is seen.
  void explain(const QString& sentence);
  /// What stands in place of the panel; empty: the panel does.
  QString sentence() const { return currentIndex() == 0 ? QString() : sentence_->text(); }

 private:
  QLabel* sentence_;
};

}  // namespace volumen
