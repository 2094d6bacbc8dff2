#include "ui/views/colour_bar.h"

#include <cmath>

#include "results/pictures/readable_text.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {

// Logical pixels.
constexpr double barWidth = 8, fromEdge = 8, besideBar = 5, highestBar = 140, lowestBar = 50;
constexpr double numbersWidth = 48, reachOut = 8, reachIn = 14;

enum class BarEnd { dark, bright };

std::optional<BarEnd> barEndAt(const QRectF& area, QPointF p) {
  const QRectF bar = colourBarRect(area);
  if (bar.isEmpty() || !isOnColourBar(area, p)) return {};
  if (p.y() <= bar.top() + reachIn) return BarEnd::bright;
  return p.y() >= bar.bottom() - reachIn ? std::optional(BarEnd::dark) : std::nullopt;
}

class BarEndDrag : public Drag {
 public:
  BarEndDrag(Session& session, const ColourBar& bar, BarEnd end, QPointF at, double height)
      : session_(session), bar_(bar), end_(end), at_(at), height_(height) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers keys) override {
    const double up = windowDragSpeed(keys) * (at_.y() - p.y()) / height_;
    const double least = std::copysign(narrowestWindow(*bar_.series), bar_.window.width);
    WindowEnds ends = endsOf(bar_.window);
    // An end cannot move past the other end.
    const auto width = [&](double wanted) { return wanted / least < 1 ? least : wanted; };
    if (end_ == BarEnd::bright)
      ends.bright = ends.dark + width(bar_.window.width * (1 + up));
    else
      ends.dark = ends.bright - width(bar_.window.width * (1 - up));
    setBarWindow(session_, bar_, windowBetween(ends));
  }

 private:
  Session& session_;
  const ColourBar bar_;
  const BarEnd end_;
  const QPointF at_;
  const double height_;
};

}  // namespace

std::optional<ColourBar> colourBarOf(const Session& session, ViewId view) {
  const Workspace& workspace = session.workspace();
  const LoadedSeriesPtr shown = session.seriesOf(view);
  if (!shown || !showsSlices(workspace.view(view).kind)) return {};
  const FlatLook look = flatLookOf(workspace.view(view));
  if (const LoadedSeriesPtr over = session.seriesNamed(look.overlay))
    return ColourBar{view, over, look.overlayColours, overlayWindow(workspace.series.at(look.overlay), *over),
                     true};
  const SeriesState series = seriesStateIn(workspace, view);
  if (series.colours == ColourMap::grey) return {};
  return ColourBar{view, shown, series.colours, flatWindow(series, *shown), false};
}

QRectF colourBarRect(const QRectF& area) {
  const double high = std::min(highestBar, area.height() / 3);
  if (high < lowestBar) return {};
  return {area.left() + fromEdge, area.center().y() + 12, barWidth, high};
}

void paintColourBar(QPainter& painter, const QRectF& area, const ColourBar& shown) {
  const QRectF bar = colourBarRect(area);
  if (bar.isEmpty()) return;
  const ColourTable& colours = colourTable(shown.map);
  for (int row = 0; row < int(bar.height()); ++row)
    painter.fillRect(QRectF(bar.x(), bar.y() + row, bar.width(), 1),
                     QColor::fromRgb(colours[std::size_t(255.0 * (1 - row / (bar.height() - 1)))]));
  const QFontMetricsF metrics(painter.font());
  const Window window = shownWindow(shown.window, shown.series->series);
  const WindowEnds ends = endsOf(window);
  const auto end = [&](double value, double baseline) {
    paintReadable(painter, {bar.right() + besideBar, baseline - metrics.ascent()},
                  windowNumbers({value, window.width}).second + unitSuffix(shown.series->series), Qt::white);
  };
  end(ends.bright, bar.top() + metrics.ascent() - 2);
  end(ends.dark, bar.bottom());
}

void paintBarHandles(QPainter& painter, const QRectF& area) {
  const QRectF bar = colourBarRect(area);
  if (bar.isEmpty()) return;
  painter.setPen(Qt::black);
  painter.setBrush(Qt::white);
  for (const double y : {bar.top(), bar.bottom()})
    painter.drawRoundedRect(QRectF(bar.left() - 3, y - 2.5, bar.width() + 6, 5), 2, 2);
  painter.setBrush(Qt::NoBrush);
}

bool isOnColourBar(const QRectF& area, QPointF p) {
  const QRectF bar = colourBarRect(area);
  return !bar.isEmpty() && bar.adjusted(-reachOut, -reachOut, besideBar + numbersWidth, reachOut).contains(p);
}

bool isOnBarEnd(const QRectF& area, QPointF p) { return barEndAt(area, p).has_value(); }

std::unique_ptr<Drag> beginBarEnd(Session& session, const QRectF& area, const ColourBar& bar, QPointF at) {
  const std::optional<BarEnd> end = barEndAt(area, at);
  if (!end) return nullptr;
  return std::make_unique<BarEndDrag>(session, bar, *end, at, colourBarRect(area).height());
}

void setBarWindow(Session& session, const ColourBar& bar, const Window& window) {
  const QString text = tr("Window");
  session.change(
      text,
      [&](Workspace& w) {
        if (!bar.over) return setWindow(w, bar.view, window);
        SeriesState& state = w.series.edit(keyOf(bar.series->series));
        state.window = windowOfOverlay(window, state, *bar.series);
      },
      text);
}

}  // namespace volumen
