#pragma once

#include <QPointF>

namespace volumen {

/// What the mouse does in a view between a press and its release: edits of one gesture.
class Drag {
 public:
  virtual ~Drag() = default;
  /// The pointer, in the view's logical pixels, and the keys held.
  virtual void moveTo(QPointF p, Qt::KeyboardModifiers keys) = 0;
};

}  // namespace volumen
