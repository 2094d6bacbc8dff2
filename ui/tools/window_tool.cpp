#include <QCoreApplication>

#include "ui/tools/tool.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {

// Dragging right widens, up brightens. The speed is proportional to the width at the press.
class WindowDrag : public Drag {
 public:
  explicit WindowDrag(const SlicePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers keys) override {
    const QPointF moved = windowDragSpeed(keys) * (p - press_.at);
    const Window window = draggedWindow(press_.window, {moved.x(), moved.y()}, *press_.series);
    const QString text = QCoreApplication::translate("volumen", "Window");
    press_.session.change(
        text, [&](Workspace& w) { setWindow(w, press_.view, window); }, text);
  }

 private:
  const SlicePress press_;
};

}  // namespace

double windowDragSpeed(Qt::KeyboardModifiers keys) {
  return keys & Qt::ControlModifier ? 5 : keys & Qt::ShiftModifier ? 0.2 : 1;
}

std::unique_ptr<Drag> beginWindow(const SlicePress& press) { return std::make_unique<WindowDrag>(press); }

}  // namespace volumen
