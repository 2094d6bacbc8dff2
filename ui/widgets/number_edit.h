#pragma once

#include <QLabel>

#include "ui/widgets/typed_number.h"

namespace volumen {

/// A number to go to, over a picture: what it counts, a field, and of how many. Enter goes, Esc or a press
/// elsewhere gives up; either way it goes away. What cannot be gone to is told in it.
class NumberEdit : public QWidget {
  Q_OBJECT
 public:
  /// `now`: what stands there first; 0: nothing.
  NumberEdit(const QString& noun, int now, int count, QWidget* parent);

  /// Says a sentence behind the field, within its parent.
  void tell(const QString& sentence);
  /// It is done with.
  void leave();

 Q_SIGNALS:
  /// leave() where it is gone to, else tell().
  void chosen(int number);
  /// It goes, and the focus that it had with it.
  void closed();

 protected:
  void mousePressEvent(QMouseEvent*) override;

 private:
  TypedNumber* field_;
  QLabel* said_;
};

}  // namespace volumen
