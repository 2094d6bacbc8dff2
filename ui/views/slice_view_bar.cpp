#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "results/text/value_text.h"
#include "ui/views/colour_bar.h"
#include "ui/views/slice_view.h"
#include "ui/widgets/window_edit.h"
#include "ui/workspace/windows.h"

namespace volumen {

// Returns the bar of what is coloured: the overlay, else the series.
std::optional<ColourBar> SliceView::colourBar() const {
  if (!shown()) return {};
  const FlatLook look = flatLookOf(state());
  const auto& all = session_.workspace().series;
  if (const LoadedSeriesPtr over = session_.seriesNamed(look.overlay))
    return ColourBar{id(), over, look.overlayColours, overlayWindow(all.at(look.overlay), *over), true};
  if (seriesState().colours == ColourMap::grey) return {};
  return ColourBar{id(), shown(), seriesState().colours, flatWindow(seriesState(), *shown()), false};
}

void SliceView::paintColours(QPainter& painter) const {
  if (const std::optional<ColourBar> bar = colourBar()) paintColourBar(painter, rect(), *bar);
}

void SliceView::paintHandles(QPainter& painter) const {
  if (colourBar()) paintBarHandles(painter, rect());
}

void SliceView::mouseDoubleClickEvent(QMouseEvent* event) {
  const std::optional<ColourBar> bar = colourBar();
  if (event->button() == Qt::LeftButton && bar && isOnColourBar(rect(), event->position()))
    return typeBar(*bar);
  FlatView::mouseDoubleClickEvent(event);
}

// Opens two fields beside the bar. Setting them is one undo step.
void SliceView::typeBar(const ColourBar& bar) {
  const Series& series = bar.series->series;
  const Window now = shownWindow(bar.window, series);
  auto* edit = new WindowEdit({now.centre, std::abs(now.width)}, this, WindowEdit::Fields::ends);
  edit->setObjectName(QStringLiteral("barEdit"));
  edit->adjustSize();
  const QRectF place = colourBarRect(rect());
  edit->move(std::clamp(int(place.right()) + 8, 0, std::max(0, width() - edit->width())),
             std::clamp(int(place.center().y()), 0, std::max(0, height() - edit->height())));
  connect(edit, &WindowEdit::chosen, this, [this, bar, sign = now.width < 0 ? -1 : 1](const Window& typed) {
    if (!session_.workspace().series.contains(keyOf(bar.series->series))) return;
    session_.endGesture();
    setBarWindow(session_, bar, storedWindow({typed.centre, sign * typed.width}, bar.series->series));
    session_.endGesture();
  });
  connect(edit, &WindowEdit::closed, this, [this] { setFocus(); });
  edit->show();
  auto* field = edit->findChild<QLineEdit*>();
  field->setFocus();
  field->selectAll();
}

}  // namespace volumen
