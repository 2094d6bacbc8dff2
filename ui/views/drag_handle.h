#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>

namespace volumen {

class View;

/// A mark by which the picture of a view is dragged out of the window. It is shown while the pointer is over
/// a view with a series. It does not belong to the picture.
class DragHandle : public QWidget {
  Q_OBJECT
 public:
  /// Starts hidden.
  explicit DragHandle(View& view);

 Q_SIGNALS:
  /// The left button was pressed here and the mouse moved.
  void dragged();

 protected:
  /// Follows the pointer and the size of the view.
  bool eventFilter(QObject* view, QEvent* event) override;
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;

 private:
  void place();

  View& view_;
  std::optional<QPointF> pressedAt_;  // set while a drag may begin
};

}  // namespace volumen
