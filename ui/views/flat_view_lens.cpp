#include <QPainter>
#include <QPainterPath>
#include <cmath>

#include "ui/views/flat_view.h"

namespace volumen {

namespace {

constexpr int lensEdge = 240;  // logical pixels
const QColor lensRing(0xf2, 0xf4, 0xf6);

// Returns the plane of the lens with its size on screen and its magnification.
SlicePlane planeOfLens(SlicePlane plane, const Enlarged& lens, double ratio) {
  plane.centre = plane.patientFromPixel({lens.at.x() * ratio, lens.at.y() * ratio});
  plane.mmPerPixel /= lens.factor;
  plane.size = glm::ivec2(int(std::lround(lensEdge * ratio)));
  return plane;
}

}  // namespace

// Requests the picture of the drag's lens, if it has one.
void FlatView::askForLens() {
  const std::optional<Enlarged> wanted = drag_ ? drag_->enlarged() : std::nullopt;
  const std::optional<SlicePlane> now = wanted ? plane() : std::nullopt;
  if (!now) {
    if (lensAsked_) update();
    lensAsked_.reset();
    lens_.reset();
    return;
  }
  SliceRequest request = requestOf(planeOfLens(*now, *wanted, devicePixelRatioF()));
  request.ofLens = true;
  if (lensAsked_ == request) return;
  lensAsked_ = request;
  service_.request(std::move(request));
}

// Paints the lens above the picture and its lines, below texts. The lens stays where its picture belongs,
// which may lag behind the pointer.
void FlatView::paintLens(QPainter& painter) const {
  if (!lens_ || !shown() || !drag_ || !drag_->enlarged()) return;
  const double ratio = devicePixelRatioF();
  const glm::dvec2 middle = plane()->pixelFromPatient(lens_->request.plane.centre);
  const glm::dvec2 corner = glm::round(middle - glm::dvec2(lens_->request.plane.size) / 2.0) / ratio;
  const QRectF place(QPointF(corner.x, corner.y), QSizeF(lens_->image.size()) / ratio);
  QPainterPath circle;
  circle.addEllipse(place);
  painter.save();
  painter.setClipPath(circle);
  painter.drawImage(place.topLeft(), lens_->image);
  paintOverlays(painter, overlays(), overlayArea());
  paintColourBar(painter);
  painter.restore();
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(lensRing, 2));
  painter.drawEllipse(place);
  painter.restore();
}

}  // namespace volumen
