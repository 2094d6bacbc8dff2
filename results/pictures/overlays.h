#pragma once

#include <QPainter>
#include <QString>
#include <vector>

namespace volumen {

/// Text and scale bar written over a picture.
struct Overlays {
  QStringList topLeft;   ///< patient, series
  QStringList topRight;  ///< view, zoom
  bool isLate = false;   ///< the first of these lines is red: a clip lags behind
  QString bottomRight;   ///< level and ms
  QString warning;       ///< below the top left lines, in the warning colour: "Not calibrated: ..."
  QString left, right, top, bottom;  ///< the patient's sides at the edges
  QString date;                      ///< study date, large, at the top centre
  double mmPerPixel = 0;             ///< for the scale bar; 0: none
  QString lengthsWord;               ///< what its mm refer to, "at detector"; empty: to the patient
  QString number;                    ///< the line with the slice or frame number
  std::vector<QRectF> taken;         ///< areas that are already occupied

  /// True if there is nothing to write.
  bool empty() const {
    return topLeft.isEmpty() && topRight.isEmpty() && mmPerPixel == 0 &&
           (date + bottomRight + warning + left + right + top + bottom).isEmpty();
  }
};

/// A line of text and its position.
struct PlacedText {
  QRectF rect;
  QString text;
  bool warning = false;
  bool letter = false;  ///< names a side, in the letters' font
  bool late = false;    ///< red
  bool large = false;   ///< a date
};

/// The overlays that fit into an area, and their positions. Nothing overlaps, long lines are elided, and
/// unreadable ones are left out.
struct PlacedOverlays {
  std::vector<PlacedText> texts;
  QRectF scaleBar;        ///< with its caption; empty: none
  double scaleBarMm = 0;  ///< its length
};
PlacedOverlays placeOverlays(const Overlays& overlays, const QRectF& area, const QFont& font);

/// Returns how many lines of a corner fit into the upper half of an area.
int cornerLines(const QRectF& area, const QFont& font);

/// Returns a round length (1, 2 or 5 times a power of ten, in mm) of at most `mostPixels`.
double scaleBarMm(double mmPerPixel, double mostPixels);

void paintOverlays(QPainter& painter, const Overlays& overlays, const QRectF& area);

}  // namespace volumen
