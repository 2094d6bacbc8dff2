#include <QCoreApplication>
#include <cmath>

#include "ui/tools/tool.h"
#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

// Rotates the other planes of the frame of reference about the crosshair, in the plane of the view.
class TurnDrag : public Drag {
 public:
  explicit TurnDrag(const SlicePress& press)
      : press_(press), atPress_(crosshairOf(press.session.workspace(), press.view, *press.series)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const ViewKind kind = press_.session.workspace().view(press_.view).kind;
    const double sense = lookOf(press_).turn.mirrored ? -1 : 1;
    setCrosshair(press_.session, press_.view, *press_.series,
                 QCoreApplication::translate("volumen", "Turn planes"),
                 turnedIn(atPress_, kind, sense * (angle(p) - angle(press_.at))));
  }

 private:
  double angle(QPointF p) const {
    const QPointF from = p - press_.pixelAt(atPress_.at);
    return std::atan2(from.y(), from.x());
  }

  const SlicePress press_;
  const Crosshair atPress_;
};

// Moves the plane of a line by moving the crosshair perpendicular to the line.
class MovePlaneDrag : public Drag {
 public:
  MovePlaneDrag(const SlicePress& press, QPointF across)
      : press_(press),
        atPress_(crosshairOf(press.session.workspace(), press.view, *press.series)),
        across_(across) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const QPointF moved = QPointF::dotProduct(p - press_.at, across_) * across_;
    moveCrosshair(press_.session, press_.view, *press_.series,
                  QCoreApplication::translate("volumen", "Move plane"),
                  atPress_.at + press_.patientAt(press_.at + moved) - press_.patientAt(press_.at));
  }

 private:
  const SlicePress press_;
  const Crosshair atPress_;
  const QPointF across_;
};

}  // namespace

std::unique_ptr<Drag> beginTurn(const SlicePress& press) { return std::make_unique<TurnDrag>(press); }

std::unique_ptr<Drag> beginMovePlane(const SlicePress& press, QPointF across) {
  return std::make_unique<MovePlaneDrag>(press, across);
}

}  // namespace volumen
