#include "results/pictures/overlays.h"

#include <algorithm>
#include <cmath>

#include "results/pictures/picture_font.h"
#include "results/pictures/readable_text.h"

namespace volumen {

namespace {

constexpr double margin = 10, textGap = 6;  // pixels
constexpr int fewestCharacters = 4;         // of an elided line: fewer are useless
constexpr double longestBar = 200, shortestBar = 24;

const QColor textColour(0xf2, 0xf4, 0xf6), warningColour(0xff, 0xc8, 0x5a), lateColour(0xff, 0x6b, 0x6b),
    rimColour(0, 0, 0, 230);

QFont largeFont(QFont font) {
  font.setPointSizeF(1.6 * font.pointSizeF());
  font.setBold(true);
  return font;
}

QString lengthText(double mm) {
  return mm >= 10 ? QStringLiteral("%1 cm").arg(mm / 10) : QStringLiteral("%1 mm").arg(mm);
}

// Places items one after the other without overlap.
class Placer {
 public:
  Placer(const Overlays& overlays, const QRectF& area, const QFont& font)
      : inside_(area.adjusted(margin, margin, -margin, -margin)),
        metrics_(font),
        letters_(letterFont(font)),
        large_(largeFont(font)),
        taken_(overlays.taken) {}

  PlacedOverlays placed;

  // Places the letters of a side, centred on a point.
  void letter(const QString& text, QPointF centre) {
    const QSizeF size(letters_.horizontalAdvance(text), letters_.height());
    const QRectF rect(centre - QPointF(size.width() / 2, size.height() / 2), size);
    if (!text.isEmpty() && isFree(rect)) add({rect, text, false, true});
  }

  // Places the date, centred below a point.
  void date(const QString& text, QPointF top) {
    const double width = large_.horizontalAdvance(text);
    const QRectF rect(top.x() - width / 2, top.y(), width, large_.height());
    if (!text.isEmpty() && isFree(rect)) add({rect, text, false, false, false, true});
  }

  // Places a line at the left or right edge, elided if necessary. Returns false if a date has no room.
  bool line(const QString& text, bool right, double top, bool warning = false) {
    QRectF row(inside_.left(), top, inside_.width(), metrics_.height());
    const QString date = right || warning ? QString() : leadingDate(text);
    if (text.isEmpty() || row.bottom() > inside_.bottom()) return date.isEmpty();
    for (const QRectF& other : taken_) {
      if (!row.intersects(other.adjusted(-textGap, 0, textGap, 0))) continue;
      if (right)
        row.setLeft(std::max(row.left(), other.right() + textGap));
      else
        row.setRight(std::min(row.right(), other.left() - textGap));
    }
    if (row.width() < fewestCharacters * metrics_.averageCharWidth()) return date.isEmpty();
    // Patient and series keep both ends, because the distinguishing numbers come last.
    const Qt::TextElideMode mode = right || warning ? Qt::ElideRight : Qt::ElideMiddle;
    const bool isWhole = metrics_.horizontalAdvance(text) <= row.width();
    const QString fitting = isWhole          ? text
                            : date.isEmpty() ? metrics_.elidedText(text, mode, row.width())
                                             : date;
    const double width = metrics_.horizontalAdvance(fitting);
    if (width > row.width() || (!isWhole && fitting.size() <= fewestCharacters)) return date.isEmpty();
    row = QRectF(right ? row.right() - width : row.left(), top, width, metrics_.height());
    if (!isFree(row)) return date.isEmpty();
    add({row, fitting, warning});
    return true;
  }

  // Places the bar in the centre, or in the middle of the free room at the bottom.
  void scaleBar(double mmPerPixel) {
    const double height = metrics_.height() + 8, top = inside_.bottom() - height;
    double left = inside_.left(), right = inside_.right();
    for (const QRectF& other : taken_) {
      if (other.bottom() < top) continue;
      if (other.center().x() < inside_.center().x())
        left = std::max(left, other.right() + textGap);
      else
        right = std::min(right, other.left() - textGap);
    }
    const double room = std::min({longestBar, inside_.width() / 4, right - left});
    if (room < shortestBar) return;
    const double mm = volumen::scaleBarMm(mmPerPixel, room);
    const double width = std::max(mm / mmPerPixel, metrics_.horizontalAdvance(lengthText(mm)));
    const double x =
        std::clamp(inside_.center().x(), left + width / 2, std::max(left + width / 2, right - width / 2));
    const QRectF rect(std::round(x - width / 2), top, width, height);
    if (!isFree(rect)) return;
    taken_.push_back(rect);
    placed.scaleBar = rect;
    placed.scaleBarMm = mm;
  }

  const QRectF& inside() const { return inside_; }
  double lineHeight() const { return metrics_.height() + 1; }
  double letterHeight() const { return letters_.height(); }
  double letterWidth(const QString& text) const { return letters_.horizontalAdvance(text); }

 private:
  bool isFree(const QRectF& rect) const {
    return inside_.adjusted(-1, -1, 1, 1).contains(rect) &&
           std::ranges::none_of(taken_, [&](const QRectF& other) { return rect.intersects(other); });
  }
  void add(const PlacedText& text) {
    placed.texts.push_back(text);
    taken_.push_back(text.rect);
  }

  QRectF inside_;
  QFontMetricsF metrics_, letters_, large_;
  std::vector<QRectF> taken_;
};

void paintText(QPainter& painter, const PlacedText& placed) {
  paintReadable(painter, placed.rect.topLeft(), placed.text,
                placed.late      ? lateColour
                : placed.warning ? warningColour
                                 : textColour);
}

void paintScaleBar(QPainter& painter, const PlacedOverlays& placed, double mmPerPixel) {
  const QRectF& rect = placed.scaleBar;
  const double pixels = placed.scaleBarMm / mmPerPixel, y = rect.bottom() - 2;
  const double left = std::round(rect.center().x() - pixels / 2);
  for (const auto& [colour, width] : {std::pair(rimColour, 4.0), std::pair(textColour, 2.0)}) {
    painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(QPointF(left, y), QPointF(left + pixels, y));
    for (double x : {left, left + pixels}) painter.drawLine(QPointF(x, y - 4), QPointF(x, y + 1));
  }
  const QString text = lengthText(placed.scaleBarMm);
  const double width = QFontMetricsF(painter.font()).horizontalAdvance(text);
  paintText(painter, {QRectF(rect.center().x() - width / 2, rect.top(), width, rect.height()), text});
}

}  // namespace

double scaleBarMm(double mmPerPixel, double mostPixels) {
  const double most = mmPerPixel * mostPixels, power = std::pow(10.0, std::floor(std::log10(most)));
  for (double factor : {5.0, 2.0})
    if (factor * power <= most) return factor * power;
  return power;
}

int cornerLines(const QRectF& area, const QFont& font) {
  constexpr int fewest = 2;
  return std::max(fewest, int((area.height() / 2 - margin) / (QFontMetricsF(font).height() + 1)));
}

PlacedOverlays placeOverlays(const Overlays& o, const QRectF& area, const QFont& font) {
  Placer placer(o, area, font);
  const QRectF inside = placer.inside();
  const QPointF middle = inside.center();
  const double half = placer.letterHeight() / 2, line = placer.lineHeight();
  placer.letter(o.left, {inside.left() + placer.letterWidth(o.left) / 2, middle.y()});
  placer.letter(o.right, {inside.right() - placer.letterWidth(o.right) / 2, middle.y()});
  placer.letter(o.top, {middle.x(), inside.top() + half});
  placer.letter(o.bottom, {middle.x(), inside.bottom() - line - 10 - half});
  placer.date(o.date, {middle.x(), inside.top() + (o.top.isEmpty() ? 0 : 2 * half)});
  for (int n = 0; n < o.topRight.size(); ++n) placer.line(o.topRight[n], true, inside.top() + n * line);
  if (o.isLate)
    for (PlacedText& text : placer.placed.texts)
      text.late = !o.topRight.isEmpty() && text.text == o.topRight.front();
  double below = inside.top() + double(o.topLeft.size()) * line;
  for (int n = 0; n < o.topLeft.size(); ++n)
    if (!placer.line(o.topLeft[n], false, inside.top() + n * line)) {
      placer.line(o.topLeft[n], false, below);
      below += line;
    }
  for (const QString& warning : o.warning.split(QLatin1Char('\n'))) {
    placer.line(warning, false, below, true);
    below += line;
  }
  placer.line(o.bottomRight, true, inside.bottom() - line);
  if (o.mmPerPixel > 0) placer.scaleBar(o.mmPerPixel);
  return placer.placed;
}

void paintOverlays(QPainter& painter, const Overlays& overlays, const QRectF& area) {
  painter.setRenderHint(QPainter::Antialiasing);
  const QFont font = painter.font();
  const PlacedOverlays placed = placeOverlays(overlays, area, font);
  if (!placed.scaleBar.isEmpty()) paintScaleBar(painter, placed, overlays.mmPerPixel);
  for (const PlacedText& text : placed.texts) {
    painter.setFont(text.letter ? letterFont(font) : text.large ? largeFont(font) : font);
    paintText(painter, text);
  }
}

}  // namespace volumen
