#include "results/pictures/paint_graphics.h"

#include <QPolygonF>
#include <algorithm>
#include <cmath>
#include <utility>

#include "results/pictures/picture_font.h"
#include "results/pictures/readable_text.h"

namespace volumen {

namespace {

class LayerPainter {
 public:
  LayerPainter(QPainter& painter, const FramePresentation& how, const AnnotationPlaces& places,
               std::vector<QRectF> taken)
      : painter_(painter), how_(how), at_(places), taken_(std::move(taken)) {}

  void paint(const std::string& layer, const QColor& colour) {
    painter_.setPen(colour);
    for (const Graphic& graphic : how_.graphics)
      if (graphic.layer == layer) paint(graphic, colour);
    for (const GraphicText& text : how_.texts)
      if (text.layer == layer) paint(text);
  }

 private:
  static bool isNear(const QPointF& p) {
    constexpr double farthest = 1e5;
    return std::abs(p.x()) < farthest && std::abs(p.y()) < farthest;
  }

  void paint(const Graphic& graphic, const QColor& colour) {
    QPolygonF line;
    for (const glm::dvec2 point : outlineOf(graphic)) line << at_(point, graphic.units);
    if (!std::ranges::all_of(line, isNear)) return;
    const bool closed = line.size() > 2 && line.front() == line.back();
    painter_.setBrush(graphic.filled && closed ? QBrush(colour) : QBrush());
    if (graphic.type == GraphicType::point)
      paintCross(line.front());
    else
      closed ? painter_.drawPolygon(line) : painter_.drawPolyline(line);
  }

  void paintCross(const QPointF& p) {
    constexpr double arm = 3;
    painter_.drawLine(p - QPointF(arm, 0), p + QPointF(arm, 0));
    painter_.drawLine(p - QPointF(0, arm), p + QPointF(0, arm));
  }

  // Moves a text down below everything it would touch.
  QRectF freePlace(QRectF place, int flags, const QString& words) {
    constexpr double gap = 4;
    QRectF lines = painter_.boundingRect(place, flags, words);
    const auto touches = [&](const QRectF& other) { return lines.intersects(other); };
    for (auto other = std::ranges::find_if(taken_, touches); other != taken_.end();
         other = std::ranges::find_if(taken_, touches)) {
      const double down = other->bottom() + gap - lines.top();
      place.translate(0, down);
      lines.translate(0, down);
    }
    if (!taken_.empty()) taken_.push_back(lines);
    return place;
  }

  void paint(const GraphicText& text) {
    constexpr qsizetype mostLetters = 4096;
    const QString words = QString::fromStdString(text.text).left(mostLetters);
    const QPointF anchor = text.anchor ? at_(text.anchor->point, text.anchor->units) : QPointF();
    if (!isNear(anchor)) return;
    QRectF place(anchor + QPointF(3, 3), QSizeF());
    int flags = Qt::AlignLeft | Qt::AlignTop | Qt::TextDontClip;
    if (text.box) {
      using Justified = GraphicText::Box::Justified;
      place = QRectF(at_(text.box->topLeft, text.box->units), at_(text.box->bottomRight, text.box->units))
                  .normalized();
      if (!isNear(place.topLeft()) || !isNear(place.bottomRight())) return;
      flags |= text.box->justified == Justified::right    ? Qt::AlignRight
               : text.box->justified == Justified::centre ? Qt::AlignHCenter
                                                          : Qt::AlignLeft;
    }
    const bool ofDisplay = text.box      ? text.box->units == AnnotationUnits::display
                           : text.anchor ? text.anchor->units == AnnotationUnits::display
                                         : false;
    if (ofDisplay) place = freePlace(place, flags, words);
    if (text.box && text.anchor && text.anchor->visible) painter_.drawLine(place.center(), anchor);
    paintReadable(painter_, place, flags, words, painter_.pen().color());
  }

  QPainter& painter_;
  const FramePresentation& how_;
  const AnnotationPlaces& at_;
  std::vector<QRectF> taken_;
};

QColor layerColour(const GraphicLayer& layer) {
  if (layer.colour) return {layer.colour->x, layer.colour->y, layer.colour->z};
  return QColor::fromRgbF(layer.grey, layer.grey, layer.grey);
}

}  // namespace

void paintGraphics(QPainter& painter, const FramePresentation& how, const AnnotationPlaces& places,
                   std::vector<QRectF> taken) {
  painter.setRenderHint(QPainter::Antialiasing);
  LayerPainter layers(painter, how, places, std::move(taken));
  for (const GraphicLayer& layer : how.layers) layers.paint(layer.name, layerColour(layer));
  painter.setBrush(Qt::NoBrush);
}

void paintGraphics(QImage& image, const FramePresentation& how, const PresentedGrid& grid) {
  image = image.convertToFormat(QImage::Format_RGB32);
  QPainter painter(&image);
  QFont font = pictureFont();
  font.setPixelSize(std::clamp(image.height() / 40, 9, 32));
  painter.setFont(font);
  paintGraphics(painter, how, [&](glm::dvec2 position, AnnotationUnits units) {
    const glm::dvec2 p = grid.displayed(position, units);
    return QPointF(p.x, p.y);
  });
}

}  // namespace volumen
