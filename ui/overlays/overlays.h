#pragma once

#include <QPainter>
#include <QString>
#include <vector>

namespace volumen {

/// What is written over a picture.
struct Overlays {
  QStringList topLeft;               ///< patient, series
  QStringList topRight;              ///< view, zoom
  bool isLate = false;               ///< the first of these lines is red: a clip is too slow
  QString bottomRight;               ///< level and ms
  QString warning;                   ///< under the top left, in the warning colour: "Not calibrated: ..."
  QString left, right, top, bottom;  ///< the patient's sides at the edges
  QString date;                      ///< of the study, large, in the middle of the top
  double mmPerPixel = 0;             ///< for the scale bar; 0: none
  std::vector<QRectF> taken;         ///< where something else stands already

  /// Whether there is nothing to write.
  bool empty() const {
    return topLeft.isEmpty() && topRight.isEmpty() && mmPerPixel == 0 &&
           (date + bottomRight + warning + left + right + top + bottom).isEmpty();
  }
};

/// One line of text and its place.
struct PlacedText {
  QRectF rect;
  QString text;
  bool warning = false;
  bool letter = false;  ///< of a side, in the letters' font
  bool late = false;    ///< red
  bool large = false;   ///< a date
};

/// What of the overlays finds room in an area, and where: nothing touches anything else, long lines are
/// elided, and what would not be readable is left out.
struct PlacedOverlays {
  std::vector<PlacedText> texts;
  QRectF scaleBar;        ///< with its caption; empty: none
  double scaleBarMm = 0;  ///< its length
};
PlacedOverlays placeOverlays(const Overlays& overlays, const QRectF& area, const QFont& font);

/// How many lines of each corner may stand in the upper half of an area.
int cornerLines(const QRectF& area, const QFont& font);

/// A round length (1, 2 or 5 times a power of ten, mm) of at most so many pixels.
double scaleBarMm(double mmPerPixel, double mostPixels);

void paintOverlays(QPainter& painter, const Overlays& overlays, const QRectF& area);

}  // namespace volumen
