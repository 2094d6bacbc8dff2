#pragma once

#include <QColor>
#include <QImage>
#include <QPainter>
#include <QString>
#include <vector>

namespace volumen {

/// One point of a chart; a label that is empty is not drawn.
struct ChartPoint {
  double x = 0, y = 0;
  QString label;
  bool ringed = false;  ///< drawn with a ring: of the front
};

/// Points of one colour, with a line through them where they follow one another.
struct ChartSeries {
  QString name;  ///< for the legend; empty: not there
  QColor colour;
  bool line = false;
  bool faint = false;  ///< small and pale: the others' points, as a background
  std::vector<ChartPoint> points;
  bool bare = false;  ///< the line alone, without a mark at each point
};

/// What a chart is drawn with, but for its points: by default for white paper.
struct ChartColours {
  QColor ink{40, 44, 52}, note{100, 106, 116}, grid{226, 229, 234}, minorGrid{242, 244, 247};
  QColor paper{255, 255, 255};  ///< behind the legend
};

/// A chart of points over two axes, both logarithmic or both linear from 0.
struct Chart {
  QString title, note, xTitle, yTitle;  ///< the note may have two lines
  bool logarithmic = true, wholeX = false;
  std::vector<ChartSeries> series;
  std::vector<QPointF> front;  ///< a staircase drawn beneath the points, x ascending; empty: none
  QString frontName;           ///< for the legend
  ChartColours colours{};
};

/// The span of both axes over all points and the front, with a little room; for charts that share their axes.
QRectF spanOf(const Chart& chart);

/// Draws into `area`. Labels stand where they touch neither points nor each other; one that finds no room is
/// left out. `fontPx`: of labels; titles are larger.
void drawChart(QPainter& painter, const QRectF& area, const Chart& chart, const QRectF& span, int fontPx);

/// A chart alone on a white picture.
QImage chartImage(const Chart& chart, QSize size);

}  // namespace volumen
