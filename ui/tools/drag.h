#pragma once

#include <QPointF>

namespace volumen {

struct Measurement;

/// What the mouse does in a view between a press and its release, or of several presses: edits of one
/// gesture. Places are in the view's logical pixels.
class Drag {
 public:
  virtual ~Drag() = default;
  /// The pointer, and the keys held; between two presses too.
  virtual void moveTo(QPointF p, Qt::KeyboardModifiers keys) = 0;
  /// Another press, of a drag that goes on.
  virtual void press(QPointF) {}
  /// The button was released; whether that ends it.
  virtual bool release(QPointF) { return true; }
  /// Enter or a double-click; whether that ends it.
  virtual bool finish() { return true; }
  /// What it draws that is no part of the workspace yet; null: nothing.
  virtual const Measurement* drawing() const { return nullptr; }
};

}  // namespace volumen
