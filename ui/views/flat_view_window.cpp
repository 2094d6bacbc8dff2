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

std::optional<Window> FlatView::windowShown() const {
  return shown() && hasWindow() ? std::optional(greyWindow()) : std::nullopt;
}

QString FlatView::windowLine(const QString& words) const {
  const bool isAlone = !words.isEmpty() && flatLookOf(state()).windowAlone;
  return isAlone ? tr("%1 (this view)").arg(words) : words;
}

// Returns the rectangle of the window's numbers; empty if there are none.
QRectF FlatView::windowRect() const {
  return shown() && hasWindow() ? cornerRect(overlays().bottomRight) : QRectF();
}

// Opens two fields at the numbers. Setting them is one undo step.
void FlatView::typeWindow() {
  const LoadedSeriesPtr shown = this->shown();
  const Window now = shownWindow(greyWindow(), shown->series);
  auto* edit = new WindowEdit({now.centre, std::abs(now.width)}, this);
  edit->setObjectName(QStringLiteral("windowEdit"));
  edit->adjustSize();
  edit->move(std::max(0, width() - 8 - edit->width()), std::max(0, height() - 4 - edit->height()));
  connect(edit, &WindowEdit::chosen, this, [this, shown, sign = now.width < 0 ? -1 : 1](const Window& typed) {
    if (!this->shown()) return;
    session_.endGesture();
    session_.change(tr("Window"), [&](Workspace& w) {
      setWindow(w, id(), storedWindow({typed.centre, sign * typed.width}, shown->series));
    });
  });
  connect(edit, &WindowEdit::closed, this, [this] { setFocus(); });
  edit->show();
  auto* field = edit->findChild<QLineEdit*>();
  field->setFocus();
  field->selectAll();
}

// The fields belong to what was shown before.
void FlatView::closeFields() {
  for (NumberEdit* edit : findChildren<NumberEdit*>()) edit->leave();
  for (WindowEdit* edit : findChildren<WindowEdit*>()) edit->leave();
}

}  // namespace volumen
