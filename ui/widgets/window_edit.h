#pragma once

#include <QLineEdit>

#include "viewer/volume/volume.h"

namespace volumen {

/// Two fields for the width and the centre of a window. Enter sets, Esc or a press elsewhere gives up; either
/// way it goes.
class WindowEdit : public QWidget {
  Q_OBJECT
 public:
  /// `window`: what stands there first, its width above 0.
  WindowEdit(const Window& window, QWidget* parent);

 Q_SIGNALS:
  void chosen(const volumen::Window& window);
  /// It goes, and its focus with it.
  void closed();

 protected:
  void keyPressEvent(QKeyEvent*) override;
  void mousePressEvent(QMouseEvent*) override;

 private:
  void accept();
  void leave();

  QLineEdit *width_, *centre_;
};

}  // namespace volumen
