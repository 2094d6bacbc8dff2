#pragma once

#include <QFrame>
#include <QLabel>

namespace volumen {

/// A frame over a drop target, with the effect of dropping in its centre.
class DropMark : public QFrame {
  Q_OBJECT
 public:
  /// Starts hidden.
  explicit DropMark(QWidget* parent);

  void tell(const QString& whatItDoes) { text_->setText(whatItDoes); }
  QString text() const { return text_->text(); }

 private:
  QLabel* text_;
};

}  // namespace volumen
