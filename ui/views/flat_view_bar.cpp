#include <algorithm>

#include "ui/views/clip_lines.h"
#include "ui/views/colour_bar.h"
#include "ui/views/cross_lines.h"
#include "ui/views/flat_view.h"
#include "ui/widgets/window_edit.h"

namespace volumen {

void FlatView::paintColourBar(QPainter& painter) const {
  if (const std::optional<ColourBar> bar = colourBarOf(session_, id()))
    volumen::paintColourBar(painter, rect(), *bar);
}

std::unique_ptr<Drag> FlatView::pressLine(const SlicePress& press) const {
  if (!showsSlices(state().kind)) return nullptr;
  if (const std::optional<ColourBar> bar = colourBarOf(session_, id()))
    if (std::unique_ptr<Drag> drag = beginBarEnd(session_, rect(), *bar, press.at)) return drag;
  std::unique_ptr<Drag> drag = beginOnLines(press, hasCrosshairTool());
  return drag ? std::move(drag) : beginOnClip(press, highlights_.clip);
}

bool FlatView::isOnLine(const SlicePress& press) const {
  if (!showsSlices(state().kind)) return false;
  if (colourBarOf(session_, id()) && isOnBarEnd(rect(), press.at)) return true;
  return isOnLines(press, hasCrosshairTool()) || isOnClip(press, highlights_.clip);
}

// Opens two fields beside the bar.
void FlatView::typeBar(const ColourBar& bar) {
  WindowEdit* edit = openWindowEdit(bar.window, bar.series, true,
                                    [this, bar](const Window& typed) { setBarWindow(session_, bar, typed); });
  edit->setObjectName(QStringLiteral("barEdit"));
  const QRectF place = colourBarRect(rect());
  edit->move(std::clamp(int(place.right()) + 8, 0, std::max(0, width() - edit->width())),
             std::clamp(int(place.center().y()), 0, std::max(0, height() - edit->height())));
}

}  // namespace volumen
