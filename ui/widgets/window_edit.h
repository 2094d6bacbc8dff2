#pragma once

#include <QLineEdit>
#include <optional>

#include "viewer/volume/volume.h"

namespace volumen {

/// Two fields for the width and centre of a window, or for its ends. Enter sets them, Esc or a press
/// elsewhere cancels; both close it.
class WindowEdit : public QWidget {
  Q_OBJECT
 public:
  enum class Fields { widthAndCentre, ends };
  /// `window` holds the initial values; its width is above 0.
  WindowEdit(const Window& window, QWidget* parent, Fields fields = Fields::widthAndCentre);

  /// Closes the fields.
  void leave();

 Q_SIGNALS:
  void chosen(const volumen::Window& window);
  /// The fields close and lose focus.
  void closed();

 protected:
  bool event(QEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void mousePressEvent(QMouseEvent*) override;

 private:
  void accept();

  std::optional<Window> typed() const;

  const Fields fields_;
  QLineEdit *first_, *second_;  // width and centre, or lowest and highest value
};

}  // namespace volumen
