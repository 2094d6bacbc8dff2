#include <algorithm>

#include "results/text/text.h"
#include "ui/views/cine_bar.h"
#include "ui/views/flat_view.h"
#include "ui/widgets/number_edit.h"

namespace volumen {

namespace {

constexpr int bottomEdge = 6;  // height below all texts where the pointer shows the cine bar

// Shows the position under the pointer.
class StackBarDrag : public Drag {
 public:
  explicit StackBarDrag(FlatView& view) : view_(view) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    if (const std::optional<StackBar> bar = view_.stackBar()) view_.goTo(bar->placeAt(p.y()));
  }

 private:
  FlatView& view_;
};

}  // namespace

QRectF FlatView::stackArea() const {
  const int bottom = height() - (cine_->isHidden() ? 0 : CineBar::barHeight);
  return QRectF(width() - StackBar::edge, 0, StackBar::edge, bottom);
}

std::optional<StackBar> FlatView::stackBar() const {
  const Stack stack = this->stack();
  if (!shown() || stack.place.count < 2) return {};
  return StackBar{stackArea(),
                  stack.place,
                  keyImagePlaces(session_.workspace(), *seriesState().series, stack),
                  {{0, stack.place.count - 1}},
                  isBarThick_};
}

// Drawing tools and measurements under the pointer come first.
bool FlatView::isOnStackBar(QPointF p) const {
  return stackArea().contains(p) && shown() && stack().place.count > 1 && !tool_->draws() &&
         !measurementAt(p);
}

std::unique_ptr<Drag> FlatView::pressStackBar(QPointF p) {
  if (!isOnStackBar(p)) return nullptr;
  auto drag = std::make_unique<StackBarDrag>(*this);
  drag->moveTo(p, {});
  return drag;
}

// Shows the bars near the pointer.
void FlatView::tellEdges(QPointF p) {
  const bool isThick = isOnStackBar(p);
  if (std::exchange(isBarThick_, isThick) != isThick) update(stackArea().toAlignedRect());
  const int edge = cine_->isHidden() ? bottomEdge : CineBar::barHeight;
  cine_->pointAtEdge(rect().contains(p.toPoint()) && p.y() >= height() - edge && !isThick);
}

void FlatView::goTo(int place) {
  stop();
  moveTo(place);
}

// Frames are counted from the one requested last, which may still be read.
void FlatView::scroll(int steps) {
  if (steps == 0) return;
  stop();
  moveTo(stackIn(session_.workspace(), id(), shown()).place.index + steps);
}

void FlatView::togglePlay() { cine_->togglePlay(); }

bool FlatView::isPlaying() const { return cine_->isPlaying(); }

void FlatView::stop() { cine_->stop(); }

// Returns the rectangle of a corner text; empty if it is not shown.
QRectF FlatView::cornerRect(const QString& line) const {
  const PlacedOverlays placed = placeOverlays(overlays(), overlayArea(), font());
  const auto text = std::ranges::find(placed.texts, line, &PlacedText::text);
  return text == placed.texts.end() ? QRectF() : text->rect;
}

QRectF FlatView::numberRect() const {
  return shown() && stack().numberCount > 1 ? cornerRect(overlays().number) : QRectF();
}

// Opens a field if editable numbers were pressed. Returns whether they were.
bool FlatView::pressCorner(QPointF p) {
  if (tool_->draws() || tool_->looking) return false;
  const bool isWindow = windowRect().contains(p);
  if (isWindow) typeWindow();
  const bool isNumber = !isWindow && numberRect().contains(p);
  if (isNumber) typeNumber();
  return isWindow || isNumber;
}

void FlatView::typeNumber() {
  if (!shown() || stack().numberCount < 2) return;
  const auto open = findChildren<NumberEdit*>();
  for (NumberEdit* edit : open)
    if (!edit->isHidden()) return edit->setFocus();
  session_.setFocus(id());
  stop();
  const Stack now = stack();
  const QRectF line = numberRect();
  auto* edit = new NumberEdit(now.noun, now.number, now.numberCount, this);
  edit->adjustSize();
  const int right = line.isEmpty() ? width() - StackBar::edge : int(line.right());
  edit->move(std::max(0, right - edit->width()), std::max(0, int(line.top()) - 2));
  connect(edit, &NumberEdit::chosen, this, [this, edit](int number) {
    if (!shown()) return edit->leave();
    const std::optional<int> place = stack().placeOf(number);
    if (!place)
      return edit->tell(tr("Slice %1 is not in the volume: choose View > Show as frames.").arg(number));
    session_.endGesture();
    goTo(*place);
    session_.endGesture();
    edit->leave();
  });
  connect(edit, &NumberEdit::closed, this, [this] { setFocus(); });
  edit->show();
  edit->setFocus();
}

}  // namespace volumen
