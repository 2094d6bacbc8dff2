// An addition: a slice tool whose upward drags move the window to higher values.
#include "ui/tools/tool.h"

namespace volumen {

namespace {

class LevelDrag : public Drag {
 public:
  explicit LevelDrag(const SlicePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    Window window = press_.window;
    window.centre += press_.at.y() - p.y();
    const QString text = QStringLiteral("Level");
    press_.session.change(
        text, [&](Workspace& w) { w.series.edit(keyOf(press_.series->series)).window = window; }, text);
  }

 private:
  const SlicePress press_;
};

}  // namespace

std::unique_ptr<Drag> beginLevel(const SlicePress& press) { return std::make_unique<LevelDrag>(press); }

}  // namespace volumen
