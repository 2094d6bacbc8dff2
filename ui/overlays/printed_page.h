#pragma once

#include <QImage>
#include <QRectF>
#include <optional>

class QPainter;

namespace volumen {

/// A picture that is printed.
struct PrintedPicture {
  QImage picture;
  std::optional<double>
      mmPerPixel;  ///< of the picture, where it is printed in true size; none: as large as fits
};

/// Where it lies on the paper, mm from the top left corner of what can be printed on: in the middle, whole,
/// but in true size as large as it is.
QRectF placeOnPaper(const PrintedPicture& printed, QSizeF paperMm);

/// Paints it; `painter` is in pixels of `dotsPerMm` and begins at the top left corner of what can be printed
/// on.
void paintPage(QPainter& painter, const PrintedPicture& printed, QSizeF paperMm, double dotsPerMm);

}  // namespace volumen
