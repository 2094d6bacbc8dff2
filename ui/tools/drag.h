#pragma once

#include <QPointF>
#include <QSizeF>
#include <optional>

class QPainter;

namespace volumen {

struct Measurement;
struct SeriesKey;
struct SlicePlane;

/// What is seen through a lens.
struct Enlarged {
  QPointF at;         ///< its middle, where the picture is enlarged about
  double factor = 1;  ///< how much larger than in the view
};

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
  virtual bool release(QPointF, Qt::KeyboardModifiers) { return true; }
  /// Enter or a double-click; whether that ends it.
  virtual bool finish() { return true; }
  /// A key was pressed; whether it is taken: nothing else hears of it.
  virtual bool takesKey(int /*key*/) { return false; }
  /// What it draws that is no part of the workspace yet; null: nothing.
  virtual const Measurement* drawing() const { return nullptr; }
  /// Whether that has numbers.
  virtual bool isMeasured() const { return true; }
  /// Whether it draws over the picture what is no part of the workspace yet, and draws that over a picture of
  /// `size` logical pixels.
  virtual bool drawsOver() const { return false; }
  virtual void paint(QPainter&, QSizeF /*size*/) const {}
  /// It ends before it is done, where a view says so.
  virtual void giveUp() {}
  /// The lens that it holds; none: it holds none.
  virtual std::optional<Enlarged> enlarged() const { return {}; }
  /// Whether the view may be scrolled under it: what it draws reaches across slices.
  virtual bool scrolls() const { return false; }
  /// Of one that scrolls: the plane that the view shows now, in device pixels.
  virtual void planeChanged(const SlicePlane&) {}
  /// So many notches of the wheel, up is positive; whether they mean something to it.
  virtual bool wheel(double /*notches*/) { return false; }
};

/// The same in a 3D view. What is drawn over it is given up where the view is resized, or its camera moved by
/// something else: it would lie over another place.
class SceneDrag : public Drag {
 public:
  /// Whether it goes on where the view shows this series by now, another step in time too.
  virtual bool goesOnIn(const SeriesKey&) const { return true; }
  /// Whether a press that did not move points at a place.
  virtual bool pointsWhereStill() const { return false; }
};

}  // namespace volumen
