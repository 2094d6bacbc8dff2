#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "io/study/frame_series.h"
#include "ui/tools/tool.h"
#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

// The height of the view scrolls through the whole stack, at two pixels or more per slice.
class ScrollDrag : public Drag {
 public:
  explicit ScrollDrag(const SlicePress& press)
      : press_(press),
        kind_(press.session.workspace().view(press.view).kind),
        atPress_(crosshairOf(press.session.workspace(), press.view, *press.series)),
        frameAtPress_(lookOf(press).frame) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const VoxelGeometry& geometry = press_.series->volume->geometry();
    const int count = showsFrames(kind_) ? frameCount(*seriesIn(press_.session.workspace(), press_.view))
                                         : stackPlace(geometry, kind_, atPress_).count;
    const double height = press_.plane.size.y / press_.pixelRatio;
    const int steps = int(std::lround((p.y() - press_.at.y()) / std::max(2.0, height / std::max(count, 8))));
    if (showsFrames(kind_)) return showFrame(press_.session, press_.view, frameAtPress_ + steps);
    moveCrosshair(press_.session, press_.view, *press_.series,
                  QCoreApplication::translate("volumen", "Scroll"),
                  scrolled(geometry, kind_, atPress_, steps));
  }

 private:
  const SlicePress press_;
  const ViewKind kind_;
  const Crosshair atPress_;
  const int frameAtPress_;
};

}  // namespace

std::unique_ptr<Drag> beginScroll(const SlicePress& press) { return std::make_unique<ScrollDrag>(press); }

}  // namespace volumen
