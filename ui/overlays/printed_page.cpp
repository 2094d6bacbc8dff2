#include "ui/overlays/printed_page.h"

#include <QPainter>

namespace volumen {

QRectF placeOnPaper(const PrintedPicture& printed, QSizeF paperMm) {
  const QSizeF pixels = printed.picture.size();
  const QSizeF mm =
      printed.mmPerPixel ? pixels * *printed.mmPerPixel : pixels.scaled(paperMm, Qt::KeepAspectRatio);
  return {QPointF((paperMm.width() - mm.width()) / 2, (paperMm.height() - mm.height()) / 2), mm};
}

void paintPage(QPainter& painter, const PrintedPicture& printed, QSizeF paperMm, double dotsPerMm) {
  const QRectF place = placeOnPaper(printed, paperMm);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(QRectF(place.topLeft() * dotsPerMm, place.size() * dotsPerMm), printed.picture);
}

}  // namespace volumen
