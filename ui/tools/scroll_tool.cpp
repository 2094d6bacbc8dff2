#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "ui/tools/flat_tool.h"
#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

// The whole stack over the height of the view, but at least two pixels a slice.
class ScrollDrag : public Drag {
 public:
  explicit ScrollDrag(const FlatPress& press)
      : press_(press),
        kind_(press.session.workspace().view(press.view).kind),
        atPress_(crosshairOf(press.session.workspace(), *press.series)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const VoxelGeometry& geometry = press_.series->volume->geometry();
    const int count = stackPlace(geometry, kind_, atPress_).count;
    const double height = press_.plane.size.y / press_.pixelRatio;
    const double pixels = std::max(2.0, height / std::max(count, 8));
    moveCrosshair(press_.session, *press_.series, QCoreApplication::translate("volumen", "Scroll"),
                  scrolled(geometry, kind_, atPress_, int(std::lround((p.y() - press_.at.y()) / pixels))));
  }

 private:
  const FlatPress press_;
  const ViewKind kind_;
  const Crosshair atPress_;
};

}  // namespace

std::unique_ptr<Drag> beginScroll(const FlatPress& press) { return std::make_unique<ScrollDrag>(press); }

}  // namespace volumen
