#include <QKeyEvent>
#include <QLineEdit>
#include <QNativeGestureEvent>
#include <QPainter>
#include <algorithm>

#include "results/text/text.h"
#include "results/text/measured_text.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/views/colour_bar.h"
#include "ui/views/drawn_measurement.h"
#include "ui/views/flat_view.h"
#include "ui/views/latin_key.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"
#include "viewer/measure/shape_cut.h"

namespace volumen {

namespace {

constexpr int nameFieldWidth = 180;

// Returns the name and the results of a measurement. Values of another series than `shown` name that series;
// results of two series already do.
QStringList textOf(const Measurement& m, MeasuredNumbers& measurer, const Workspace& workspace,
                   const SeriesKey& shown) {
  QStringList text;
  if (!m.shape.name.empty()) text << nameText(m);
  const MeasuredPtr numbers = measurer.numbersOf(m);
  if (!numbers) return text;
  text << measuredLines(m.shape, *numbers);
  const auto of = workspace.series.find(m.series);
  const bool areValues = *numbers && !(*numbers)->other && ((*numbers)->values || (*numbers)->voxel);
  if (areValues && m.series != shown && of != workspace.series.end())
    text << tr("of %1").arg((QStringList{seriesText(*of->second.series), stepText(workspace, m.series)})
                                .join(QLatin1Char(' '))
                                .trimmed());
  return text;
}

}  // namespace

std::vector<const Measurement*> FlatView::measurements() const {
  const Workspace& workspace = session_.workspace();
  return showsFrames(state().kind) ? measurementsOn(workspace, *seriesState().series, stack().place.index)
                                   : measurementsIn(workspace, frameOfReference(shown()->series));
}

std::optional<ShapeFrame> FlatView::shapeFrame() const {
  if (!shown() || !showsFrames(state().kind)) return {};
  return frameNamed(*seriesState().series, stack().place.index);
}

std::vector<DrawnMeasurement> FlatView::drawnMeasurements() const {
  std::vector<DrawnMeasurement> drawn;
  const LoadedSeriesPtr shown = this->shown();
  const std::optional<SlicePlane> now = plane();
  if (!shown || !now) return drawn;
  const Workspace& workspace = session_.workspace();
  const auto add = [&](const Measurement& m, bool selected, bool measured = true) {
    DrawnMeasurement one =
        drawnMeasurement(m, *now, shown->volume->geometry(), devicePixelRatioF(), selected);
    if (one.lines.empty()) return;
    const bool isTold = one.whole || m.id < 0 || ruleOf(m.shape.kind).acrossSlices;
    if (measured && isTold) one.text = textOf(m, measurer_, workspace, state().series);
    drawn.push_back(std::move(one));
  };
  if (workspace.measurementsShown)
    for (const Measurement* m : measurements()) add(*m, m->id == workspace.selected);
  if (const Measurement* m = drag_ ? drag_->drawing() : nullptr; m && m->shape.frame == shapeFrame())
    add(*m, true, drag_->isMeasured());
  if (!drawn.empty()) placeBeside(overlays(), drawn, overlayArea(), font());
  return drawn;
}

bool FlatView::isMeasured() const {
  if (!shown() || !session_.workspace().measurementsShown) return true;
  const auto& all = session_.workspace().series;
  return std::ranges::all_of(measurements(), [&](const Measurement* m) {
    const auto state = all.find(m->series);
    const bool isNotHere =
        state == all.end() || state->second.missing || (!m->shape.frame && !session_.seriesNamed(m->series));
    return isNotHere || measurer_.exactNumbersOf(*m) != nullptr;
  });
}

std::optional<MeasurementHit> FlatView::measurementAt(QPointF p) const {
  const std::vector<DrawnMeasurement> drawn = drawnMeasurements();
  const auto hit = hitAt(drawn, p);
  const Measurement* m = hit ? findMeasurement(session_.workspace(), hit->drawn->id) : nullptr;
  if (!m) return {};
  const glm::dvec3 text = pressAt(p)->shapePointAt(hit->drawn->textRect.center());
  const bool isMovable = hit->drawn->whole || hit->part == MeasurementPart::handle;
  return MeasurementHit{m->id, hit->part, hit->handle, text - middleOf(m->shape), isMovable};
}

std::unique_ptr<Drag> FlatView::pressMeasurement(const SlicePress& press) {
  if (tool_->draws()) return nullptr;
  const auto hit = measurementAt(press.at);
  session_.select(hit ? hit->id : 0);
  return hit && hit->movable ? beginMeasurementEdit(press, *hit) : nullptr;
}

void FlatView::endDrag(Qt::KeyboardModifiers keys) {
  const bool drew = isDrawing();
  const bool kept = drew && session_.undoStack().index() > stepsAtPress_;
  takeDrag().reset();
  askForLens();
  session_.endGesture();
  tellPointed();
  if (!drew) return;
  update();
  if (!kept) return;
  const Measurement* made =
      tool_->measuring ? findMeasurement(session_.workspace(), session_.workspace().selected) : nullptr;
  if (made && isToBeNamed(session_.workspace(), *made)) askForName(made->id);
  if (!(keys & Qt::ShiftModifier) && !tool_->stays && !tool_->clicks) Q_EMIT toolDone();
}

// Opens a field at the text. Its content becomes the name on Enter or when the field loses focus.
void FlatView::askForName(int id) {
  const Measurement* m = findMeasurement(session_.workspace(), id);
  if (!m) return;
  auto* field = new QLineEdit(QString::fromStdString(m->shape.name), this);
  field->setObjectName(QStringLiteral("measurementName"));
  field->setAccessibleName(tr("Text of the measurement"));
  field->setMaxLength(200);
  field->resize(nameFieldWidth, field->sizeHint().height());
  QPointF at(20, 20);
  for (const DrawnMeasurement& d : drawnMeasurements())
    if (d.id == id) at = d.textRect.isEmpty() ? d.lines.back().back() : d.textRect.topLeft();
  field->move(std::clamp(int(at.x()), 0, std::max(0, width() - field->width())),
              std::clamp(int(at.y()), 0, std::max(0, height() - field->height())));
  connect(field, &QLineEdit::editingFinished, this, [this, field, id] {
    if (field->isHidden()) return;  // sent again as the focus leaves the hidden field
    field->hide();
    renameMeasurement(session_, id, field->text());
    field->deleteLater();
    setFocus();
  });
  field->show();
  field->setFocus();
  field->selectAll();
}

QString FlatView::measurementText(QPointF p) const {
  const auto hit = measurementAt(p);
  if (!hit) return {};
  const Measurement& m = *findMeasurement(session_.workspace(), hit->id);
  const MeasuredPtr numbers = measurer_.numbersOf(m);
  const auto& taken = session_.workspace().series.at(m.series).series;
  return numbers ? detailText(m, *numbers, *taken) : nameText(m);
}

void FlatView::showCursorAt(QPointF p) {
  const auto hit = tool_->draws() ? std::nullopt : measurementAt(p);
  if (hit)
    return setCursor(hit->part == MeasurementPart::handle ? Qt::PointingHandCursor : Qt::SizeAllCursor);
  if (isOnStackBar(p)) return setCursor(Qt::SizeVerCursor);
  if (!tool_->draws() && (windowRect().contains(p) || numberRect().contains(p)))
    return setCursor(Qt::IBeamCursor);
  const auto press = tool_->draws() ? std::nullopt : pressAt(p);
  setCursor(press && isOnLine(*press) ? Qt::PointingHandCursor : tool_->cursor);
}

// Handles the keys of tools, of deletion and of ending a line. Returns false for other keys.
bool FlatView::pressMeasuringKey(const QKeyEvent& event) {
  if (event.key() == Qt::Key_Delete && session_.workspace().selected > 0) {
    deleteMeasurement(session_, session_.workspace().selected);
    return true;
  }
  if ((event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter) && drag_) {
    if (drag_->finish()) endDrag(event.modifiers());
    return true;
  }
  if (event.key() == Qt::Key_Escape)
    for (auto* field : findChildren<QLineEdit*>(QStringLiteral("measurementName"))) {
      if (field->isHidden()) continue;
      field->hide();
      field->deleteLater();
      setFocus();
      return true;
    }
  if (event.key() == Qt::Key_Escape && !drag_ && tool_->draws()) {
    Q_EMIT toolDone();
    return true;
  }
  const Tool* tool = event.modifiers() & ~Qt::ShiftModifier ? nullptr : sliceToolOfKey(latinKey(event));
  if (tool) Q_EMIT toolWanted(*tool);
  return tool != nullptr;
}

// Letters of tools, and I for inversion, select views elsewhere in the window.
bool FlatView::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto& key = static_cast<QKeyEvent&>(*event);
    if (!(key.modifiers() & ~Qt::ShiftModifier) &&
        (sliceToolOfKey(latinKey(key)) || latinKey(key) == Qt::Key_I)) {
      event->accept();
      return true;
    }
  }
  if (event->type() == QEvent::NativeGesture && pinch(static_cast<QNativeGestureEvent&>(*event))) {
    event->accept();
    return true;
  }
  return View::event(event);
}

void FlatView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const std::optional<ColourBar> bar = colourBarOf(session_, id());
  if (bar && isOnColourBar(rect(), event->position())) return typeBar(*bar);
  if (tool_->clicks) return mousePressEvent(event);  // a further click, however soon
  if (!drag_ && isOnStackBar(event->position())) return mousePressEvent(event);
  if (drag_) {
    if (drag_->finish()) endDrag(event->modifiers());
    return;
  }
  const auto hit = measurementAt(event->position());
  if (hit && hit->part == MeasurementPart::text) return askForName(hit->id);
  View::mouseDoubleClickEvent(event);
}

}  // namespace volumen
