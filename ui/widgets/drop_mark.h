#pragma once

#include <QFrame>
#include <QLabel>

namespace volumen {

/// Lies over what something is dragged over: a frame, and in the middle what dropping it does.
class DropMark : public QFrame {
  Q_OBJECT
 public:
  /// Hidden at first.
  explicit DropMark(QWidget* parent);

  void tell(const QString& whatItDoes) { text_->setText(whatItDoes); }
  QString text() const { return text_->text(); }

 private:
  QLabel* text_;
};

}  // namespace volumen
