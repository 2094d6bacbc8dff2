#include "results/plots/chart.h"

#include <cmath>

#include "results/plots/axis.h"
#include "results/plots/labels.h"

namespace volumen {

namespace {

QFont fontOf(int px, bool bold = false) {
  QFont font;
  font.setPixelSize(px);
  font.setBold(bold);
  return font;
}

class ChartPainter {
 public:
  ChartPainter(QPainter& painter, const QRectF& area, const Chart& chart, const QRectF& span, int fontPx)
      : p_(painter), chart_(chart), px_(fontPx), area_(area) {
    const double head = (chart.title.isEmpty() ? 0.6 : 2.1) * px_ +
                        (chart.note.isEmpty() ? 0 : 1.7 * px_ * (chart.note.count(QLatin1Char('\n')) + 1));
    frame_ = area.adjusted(4.6 * px_, head, -1.2 * px_, -3.6 * px_);
    x_ = {span.left(), span.right(), frame_.left(), frame_.right(), chart.logarithmic, chart.wholeX};
    y_ = {span.top(), span.bottom(), frame_.bottom(), frame_.top(), chart.logarithmic, false};
  }

  void draw() {
    p_.setRenderHint(QPainter::Antialiasing);
    titles();
    axes();
    LabelPlaces places(frame_.adjusted(2, 2, -2, -2));
    legend(places);
    front();
    for (const ChartSeries& s : chart_.series) points(s, places);
    for (const ChartSeries& s : chart_.series) labels(s, places);
  }

 private:
  QPointF at(double x, double y) const { return {x_.pixelOf(x), y_.pixelOf(y)}; }
  double radius(const ChartSeries& s) const { return s.faint ? 0.16 * px_ : 0.34 * px_; }

  void text(const QRectF& where, int flags, const QString& what, const QFont& font, QColor colour = {}) {
    p_.setFont(font);
    p_.setPen(colour.isValid() ? colour : chart_.colours.ink);
    p_.drawText(where, flags, what);
  }

  void titles() {
    const QRectF head(area_.left() + 0.6 * px_, area_.top() + 0.4 * px_, area_.width() - 1.2 * px_,
                      1.7 * px_);
    text(head, Qt::AlignLeft | Qt::AlignVCenter, chart_.title, fontOf(int(1.25 * px_), true));
    text(head.translated(0, 1.7 * px_).adjusted(0, 0, 0, 1.7 * px_), Qt::AlignLeft | Qt::AlignTop,
         chart_.note, fontOf(px_), chart_.colours.note);
    text({frame_.left(), frame_.bottom() + 1.8 * px_, frame_.width(), 1.6 * px_}, Qt::AlignCenter,
         chart_.xTitle, fontOf(px_));
    p_.save();
    p_.translate(area_.left() + 1.1 * px_, frame_.center().y());
    p_.rotate(-90);
    text({-frame_.height() / 2, -0.8 * px_, frame_.height(), 1.6 * px_}, Qt::AlignCenter, chart_.yTitle,
         fontOf(px_));
    p_.restore();
  }

  void axes() {
    for (const Tick& t : ticksOf(x_)) {
      const double x = x_.pixelOf(t.value);
      p_.setPen(t.labelled ? chart_.colours.grid : chart_.colours.minorGrid);
      p_.drawLine(QPointF(x, frame_.top()), QPointF(x, frame_.bottom()));
      if (t.labelled)
        text({x - 40, frame_.bottom() + 0.3 * px_, 80, 1.5 * px_}, Qt::AlignHCenter | Qt::AlignTop,
             tickText(t.value), fontOf(px_));
    }
    for (const Tick& t : ticksOf(y_)) {
      const double y = y_.pixelOf(t.value);
      p_.setPen(t.labelled ? chart_.colours.grid : chart_.colours.minorGrid);
      p_.drawLine(QPointF(frame_.left(), y), QPointF(frame_.right(), y));
      if (t.labelled)
        text({frame_.left() - 5 * px_, y - px_, 4.6 * px_, 2.0 * px_}, Qt::AlignRight | Qt::AlignVCenter,
             tickText(t.value), fontOf(px_));
    }
    p_.setPen(QPen(chart_.colours.ink, 1));
    p_.setBrush(Qt::NoBrush);
    p_.drawRect(frame_);
  }

  // Draws the legend: at the lower left of a logarithmic chart, at the upper left of a linear one.
  void legend(LabelPlaces& places) {
    std::vector<std::pair<QString, QColor>> entries;
    for (const ChartSeries& s : chart_.series)
      if (!s.name.isEmpty()) entries.emplace_back(s.name, s.colour);
    if (!chart_.frontName.isEmpty()) entries.emplace_back(chart_.frontName, QColor());
    if (entries.empty()) return;
    const QFontMetricsF metrics(fontOf(px_));
    double width = 0;
    for (const auto& [name, colour] : entries) width = std::max(width, metrics.horizontalAdvance(name));
    const double line = 1.6 * px_;
    const QSizeF size(width + 3.2 * px_, line * double(entries.size()) + 0.6 * px_);
    // A front falls from the upper left to the lower right, so the lower left is empty.
    const double top =
        chart_.logarithmic ? frame_.bottom() - size.height() - 0.8 * px_ : frame_.top() + 0.8 * px_;
    const QRectF box(frame_.left() + 0.8 * px_, top, size.width(), size.height());
    p_.setPen(chart_.colours.grid);
    QColor behind = chart_.colours.paper;
    behind.setAlpha(230);
    p_.setBrush(behind);
    p_.drawRoundedRect(box, 4, 4);
    places.take(box);
    double y = box.top() + 0.3 * px_ + line / 2;
    for (const auto& [name, colour] : entries) {
      const QPointF mark(box.left() + 1.3 * px_, y);
      if (colour.isValid()) {
        p_.setPen(Qt::NoPen);
        p_.setBrush(colour);
        p_.drawEllipse(mark, 0.36 * px_, 0.36 * px_);
      } else {
        p_.setPen(QPen(QColor(120, 126, 136), 1.4, Qt::DashLine));
        p_.drawLine(mark - QPointF(0.8 * px_, 0), mark + QPointF(0.8 * px_, 0));
      }
      text({box.left() + 2.6 * px_, y - line / 2, width + px_, line}, Qt::AlignVCenter, name, fontOf(px_));
      y += line;
    }
  }

  // Draws the front as a staircase: between two points the left one is still the best.
  void front() {
    QPolygonF line;
    for (std::size_t n = 0; n < chart_.front.size(); ++n) {
      const QPointF here = at(chart_.front[n].x(), chart_.front[n].y());
      if (n > 0) line << QPointF(here.x(), line.back().y());
      line << here;
    }
    p_.setBrush(Qt::NoBrush);
    p_.setPen(QPen(QColor(120, 126, 136), 1.4, Qt::DashLine));
    p_.drawPolyline(line);
  }

  void points(const ChartSeries& s, LabelPlaces& places) {
    QPolygonF line;
    for (const ChartPoint& point : s.points) line << at(point.x, point.y);
    p_.setBrush(Qt::NoBrush);
    p_.setPen(QPen(s.colour, 1.6));
    if (s.line) p_.drawPolyline(line);
    if (s.bare) return;
    const double r = radius(s);
    for (std::size_t n = 0; n < s.points.size(); ++n) {
      p_.setPen(Qt::NoPen);
      p_.setBrush(s.colour);
      p_.drawEllipse(line[int(n)], r, r);
      if (s.points[n].ringed) {
        p_.setPen(QPen(chart_.colours.ink, 1.2));
        p_.setBrush(Qt::NoBrush);
        p_.drawEllipse(line[int(n)], r + 2.5, r + 2.5);
      }
      if (!s.faint) places.take(QRectF(line[int(n)] - QPointF(r, r), QSizeF(2 * r, 2 * r)));
    }
  }

  void labels(const ChartSeries& s, LabelPlaces& places) {
    const QFont font = fontOf(int(0.95 * px_));
    const QFontMetricsF metrics(font);
    for (const ChartPoint& point : s.points) {
      if (point.label.isEmpty()) continue;
      const QSizeF size(metrics.horizontalAdvance(point.label) + 2, metrics.height() * 0.95);
      const auto place = places.place(at(point.x, point.y), size);
      if (!place) continue;
      p_.fillRect(*place, QColor(255, 255, 255, 205));  // lines behind the label stay pale
      text(*place, Qt::AlignCenter, point.label, font, s.colour.darker(135));
    }
  }

  QPainter& p_;
  const Chart& chart_;
  int px_;
  QRectF area_, frame_;
  Axis x_, y_;
};

}  // namespace

QRectF spanOf(const Chart& chart) {
  QPointF low(1e300, 1e300), high(-1e300, -1e300);
  const auto add = [&](double x, double y) {
    low = {std::min(low.x(), x), std::min(low.y(), y)};
    high = {std::max(high.x(), x), std::max(high.y(), y)};
  };
  for (const ChartSeries& s : chart.series)
    for (const ChartPoint& p : s.points) add(p.x, p.y);
  if (low.x() > high.x()) return chart.logarithmic ? QRectF(1, 1, 9, 9) : QRectF(0, 0, 1, 1);
  if (!chart.logarithmic) return {QPointF(0, 0), QPointF(1.08 * high.x(), 1.12 * high.y())};
  // Widens each end by 9 % of the logarithmic range, which counts as at least a factor of 1.8.
  const auto widened = [](double& a, double& b) {
    const double room = std::pow(std::max(b / a, 1.8), 0.09);
    a /= room, b *= room;
  };
  widened(low.rx(), high.rx());
  widened(low.ry(), high.ry());
  return {low, high};
}

void drawChart(QPainter& painter, const QRectF& area, const Chart& chart, const QRectF& span, int fontPx) {
  ChartPainter(painter, area, chart, span, fontPx).draw();
}

QImage chartImage(const Chart& chart, QSize size) {
  QImage image(size, QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  drawChart(painter, QRectF(QPointF(0, 0), size), chart, spanOf(chart), std::max(11, size.height() / 60));
  return image;
}

}  // namespace volumen
