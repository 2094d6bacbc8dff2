#include <algorithm>
#include <cmath>

#include "ui/tools/tool.h"

namespace volumen {

namespace {

// Shows a lens at the pointer without changing the workspace.
class MagnifierDrag : public Drag {
 public:
  explicit MagnifierDrag(const SlicePress& press) : seen_{press.at, 2} {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override { seen_.at = p; }
  std::optional<Enlarged> enlarged() const override { return seen_; }
  bool wheel(double notches) override {
    seen_.factor = std::clamp(seen_.factor * std::pow(2, notches / 4), leastEnlarged, mostEnlarged);
    return true;
  }

 private:
  Enlarged seen_;
};

}  // namespace

std::unique_ptr<Drag> beginMagnifier(const SlicePress& press) {
  return std::make_unique<MagnifierDrag>(press);
}

}  // namespace volumen
