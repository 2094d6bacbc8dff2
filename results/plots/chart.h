#pragma once

#include <QColor>
#include <QImage>
#include <QPainter>
#include <QString>
#include <vector>

namespace volumen {

/// One point of a chart; an empty label is not drawn.
struct ChartPoint {
  double x = 0, y = 0;
  QString label;
  bool ringed = false;  ///< drawn with a ring: on the front
};

/// Points of one colour, optionally joined by a line.
struct ChartSeries {
  QString name;  ///< in the legend; empty: not listed
  QColor colour;
  bool line = false;
  bool faint = false;  ///< small and pale: points of others, as a background
  std::vector<ChartPoint> points;
  bool bare = false;  ///< a line without marks
};

/// Colours of a chart; the defaults are for white paper.
struct ChartColours {
  QColor ink{40, 44, 52}, note{100, 106, 116}, grid{226, 229, 234}, minorGrid{242, 244, 247};
  QColor paper{255, 255, 255};  ///< behind the legend
};

/// A chart of points over two axes, both logarithmic or both linear from 0.
struct Chart {
  QString title, note, xTitle, yTitle;  ///< the note may have two lines
  bool logarithmic = true, wholeX = false;
  std::vector<ChartSeries> series;
  std::vector<QPointF> front;  ///< a staircase below the points, x ascending; empty: none
  QString frontName;           ///< in the legend
  ChartColours colours{};
};

/// Returns the range of both axes over all points and the front, with a margin; for charts with shared axes.
QRectF spanOf(const Chart& chart);

/// Draws into `area`. Labels overlap neither points nor each other; those without room are left out. `fontPx`
/// is the size of labels; titles are larger.
void drawChart(QPainter& painter, const QRectF& area, const Chart& chart, const QRectF& span, int fontPx);

/// Returns a chart alone on white.
QImage chartImage(const Chart& chart, QSize size);

}  // namespace volumen
