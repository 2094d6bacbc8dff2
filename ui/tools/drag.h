#pragma once

#include <QPointF>
#include <QSizeF>
#include <optional>

class QPainter;

namespace volumen {

struct Measurement;
struct SeriesKey;
struct SlicePlane;
struct SlicePress;

/// The lens of the magnifier.
struct Enlarged {
  QPointF at;         ///< centre of the lens; the image is enlarged about it
  double factor = 1;  ///< magnification relative to the view
};

/// A mouse gesture in a view, over one or several presses. Its edits are one gesture, so one undo step.
/// Positions are in logical pixels of the view.
class Drag {
 public:
  virtual ~Drag() = default;
  /// Follows the pointer and the held keys, also between two presses.
  virtual void moveTo(QPointF p, Qt::KeyboardModifiers keys) = 0;
  /// Handles a further press of a gesture that lasts over several presses.
  virtual void press(QPointF) {}
  /// Handles the release of the button. Returns true if it ends the gesture.
  virtual bool release(QPointF, Qt::KeyboardModifiers) { return true; }
  /// Handles Enter or a double-click. Returns true if it ends the gesture.
  virtual bool finish() { return true; }
  /// Handles a key press. Returns true if the key is consumed.
  virtual bool takesKey(int /*key*/) { return false; }
  /// Returns the measurement being drawn, which is not yet in the workspace, or null.
  virtual const Measurement* drawing() const { return nullptr; }
  /// Returns whether drawing() has numbers to show.
  virtual bool isMeasured() const { return true; }
  /// Returns whether paint() draws something over the image that is not yet in the workspace. `size` is the
  /// size of the image in logical pixels.
  virtual bool drawsOver() const { return false; }
  virtual void paint(QPainter&, QSizeF /*size*/) const {}
  /// Returns whether paintIn() draws something over the images of all flat views.
  virtual bool drawsInAll() const { return false; }
  /// Paints in a flat view, this one included, which shows the series and plane of `shown`.
  virtual void paintIn(QPainter&, const SlicePress& /*shown*/) const {}
  /// Cancels the gesture. A view calls it.
  virtual void giveUp() {}
  /// Returns the lens, or nothing if the gesture has none.
  virtual std::optional<Enlarged> enlarged() const { return {}; }
  /// Returns whether the view may scroll during the gesture, because the drawing spans several slices.
  virtual bool scrolls() const { return false; }
  /// Receives the plane now shown, in device pixels, if scrolls() is true.
  virtual void planeChanged(const SlicePlane&) {}
  /// Handles `notches` of the wheel, positive upwards. Returns true if the gesture uses them.
  virtual bool wheel(double /*notches*/) { return false; }
};

/// A mouse gesture in a 3D view. Drawings over the view are cancelled if the view is resized or its camera is
/// moved otherwise, because they would lie elsewhere.
class SceneDrag : public Drag {
 public:
  /// Returns whether the gesture continues if the view now shows this series, such as another time point.
  virtual bool goesOnIn(const SeriesKey&) const { return true; }
  /// Returns whether a press without a movement selects a position.
  virtual bool pointsWhereStill() const { return false; }
};

}  // namespace volumen
