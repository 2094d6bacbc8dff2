#pragma once

#include <QLabel>

#include "ui/widgets/typed_number.h"

namespace volumen {

/// A field over a picture for a number to go to, with the noun and the count. Enter goes there, Esc or a
/// press elsewhere cancels; both close it. It shows the reason for an invalid number.
class NumberEdit : public QWidget {
  Q_OBJECT
 public:
  /// `now` is the initial number; 0: none.
  NumberEdit(const QString& noun, int now, int count, QWidget* parent);

  /// Shows a message after the field, within its parent.
  void tell(const QString& sentence);
  /// Closes the field.
  void leave();

 Q_SIGNALS:
  /// The receiver calls leave() for a valid number, else tell().
  void chosen(int number);
  /// The field closes and loses focus.
  void closed();

 protected:
  void mousePressEvent(QMouseEvent*) override;

 private:
  TypedNumber* field_;
  QLabel* said_;
};

}  // namespace volumen
