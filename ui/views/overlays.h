#pragma once

#include <QPainter>
#include <QString>

namespace volumen {

/// What is written over a picture.
struct Overlays {
  QStringList topLeft;               ///< patient, series
  QStringList topRight;              ///< view, zoom
  QString bottomRight;               ///< level and ms
  QString warning;                   ///< lines under the top left, in the warning colour
  QString left, right, top, bottom;  ///< the patient's sides at the edges
  double mmPerPixel = 0;             ///< for the scale bar; 0: none

  /// Whether there is nothing to write.
  bool empty() const {
    return topLeft.isEmpty() && topRight.isEmpty() && mmPerPixel == 0 &&
           (bottomRight + warning + left + right + top + bottom).isEmpty();
  }
};

/// A round length (1, 2 or 5 times a power of ten, mm) of at most so many pixels.
double scaleBarMm(double mmPerPixel, double mostPixels);

void paintOverlays(QPainter& painter, const Overlays& overlays, QRectF area);

}  // namespace volumen
