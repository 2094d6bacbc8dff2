#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/views/flat_view.h"
#include "ui/widgets/number_edit.h"
#include "ui/widgets/window_edit.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/windows.h"

namespace volumen {

void FlatView::chooseWindow(int number) {
  const std::vector<WindowChoice> choices = windows();
  if (number >= int(choices.size())) return;
  session_.change(tr("Window"),
                  [&](Workspace& w) { setWindow(w, id(), choices[std::size_t(number)].window); });
}

QString FlatView::windowLine(const QString& words) const {
  const bool isAlone = !words.isEmpty() && flatLookOf(state()).windowAlone;
  return isAlone ? tr("%1 (this view)").arg(words) : words;
}

// Returns the rectangle of the window's numbers; empty if there are none.
QRectF FlatView::windowRect() const { return windowShown() ? cornerRect(overlays().bottomRight) : QRectF(); }

// Opens two fields at the numbers.
void FlatView::typeWindow() {
  WindowEdit* edit = openWindowEdit(*windowShown(), shown(), false, [this](const Window& typed) {
    session_.change(tr("Window"), [&](Workspace& w) { setWindow(w, id(), typed); });
  });
  edit->setObjectName(QStringLiteral("windowEdit"));
  edit->move(std::max(0, width() - 8 - edit->width()), std::max(0, height() - 4 - edit->height()));
}

WindowEdit* FlatView::openWindowEdit(const Window& stored, const LoadedSeriesPtr& of, bool ends,
                                     const std::function<void(const Window&)>& set) {
  const Window now = shownWindow(stored, of->series);
  auto* edit = new WindowEdit({now.centre, std::abs(now.width)}, this,
                              ends ? WindowEdit::Fields::ends : WindowEdit::Fields::widthAndCentre);
  edit->adjustSize();
  connect(edit, &WindowEdit::chosen, this, [this, of, set, sign = now.width < 0 ? -1 : 1](Window typed) {
    if (!shown() || !session_.workspace().series.contains(keyOf(of->series))) return;
    session_.endGesture();
    set(storedWindow({typed.centre, sign * typed.width}, of->series));
    session_.endGesture();
  });
  connect(edit, &WindowEdit::closed, this, [this] { setFocus(); });
  edit->show();
  auto* field = edit->findChild<QLineEdit*>();
  field->setFocus();
  field->selectAll();
  return edit;
}

// The fields belong to what was shown before.
void FlatView::closeFields() {
  for (NumberEdit* edit : findChildren<NumberEdit*>()) edit->leave();
  for (WindowEdit* edit : findChildren<WindowEdit*>()) edit->leave();
}

}  // namespace volumen
