#include <algorithm>
#include <cmath>

#include "io/study/frame_series.h"
#include "ui/tools/tool.h"
#include "ui/workspace/stack.h"

namespace volumen {

namespace {

// The height of the view scrolls through the whole stack, at two pixels or more per slice.
class ScrollDrag : public Drag {
 public:
  explicit ScrollDrag(const SlicePress& press)
      : press_(press), atPress_(stackIn(press.session.workspace(), press.view, press.series).place) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const double height = press_.plane.size.y / press_.pixelRatio;
    const double pixels = std::max(2.0, height / std::max(atPress_.count, 8));
    const int steps = int(std::lround((p.y() - press_.at.y()) / pixels));
    goToPlace(press_.session, press_.view, press_.series, atPress_.index + steps);
  }

 private:
  const SlicePress press_;
  const StackPlace atPress_;
};

}  // namespace

std::unique_ptr<Drag> beginScroll(const SlicePress& press) { return std::make_unique<ScrollDrag>(press); }

}  // namespace volumen
