#pragma once

#include <QLineEdit>
#include <optional>

#include "viewer/volume/volume.h"

namespace volumen {

/// Two fields for the width and the centre of a window, or for its ends. Enter sets, Esc or a press elsewhere
/// gives up; either way it goes.
class WindowEdit : public QWidget {
  Q_OBJECT
 public:
  enum class Fields { widthAndCentre, ends };
  /// `window`: what stands there first, its width above 0.
  WindowEdit(const Window& window, QWidget* parent, Fields fields = Fields::widthAndCentre);

  /// It is done with.
  void leave();

 Q_SIGNALS:
  void chosen(const volumen::Window& window);
  /// It goes, and its focus with it.
  void closed();

 protected:
  bool event(QEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void mousePressEvent(QMouseEvent*) override;

 private:
  void accept();

  std::optional<Window> typed() const;

  const Fields fields_;
  QLineEdit *first_, *second_;  // width and centre, or the lowest and the highest value
};

}  // namespace volumen
