#pragma once

#include <QFontMetricsF>
#include <QPainter>
#include <QPolygonF>
#include <QStringList>
#include <functional>
#include <optional>
#include <vector>

#include "results/pictures/overlays.h"
#include "ui/tools/tool.h"
#include "ui/workspace/measurement.h"

namespace volumen {

/// A measurement as drawn in a view, in logical pixels of the view.
struct DrawnMeasurement {
  int id = 0;
  ShapeKind kind = ShapeKind::length;
  bool whole = false;  ///< whether all of it lies in the flat view's plane, not only intersections
  bool selected = false;
  std::vector<QPolygonF> lines;  ///< a line of one point is a mark
  struct Handle {
    std::size_t index = 0;  ///< index in handlesOf()
    QPointF at;
  };
  std::vector<Handle> handles;        ///< empty unless selected
  QPointF middle;                     ///< centre of the shape
  std::optional<QPointF> textMiddle;  ///< centre of a text moved by the user
  QStringList text;
  QRectF textRect;    ///< box of the text; empty if there is none or no room
  QString letter;     ///< letter drawn in place of the text if the view has a legend, otherwise empty
  QString legend;     ///< line of the legend
  QRectF legendRect;  ///< box of that line
};

/// Returns the measurement in a view of this plane (device pixels), without its text. It has no lines if
/// nothing of it is visible.
DrawnMeasurement drawnMeasurement(const Measurement& measurement, const SlicePlane& plane,
                                  const VoxelGeometry& geometry, double pixelRatio, bool selected);

/// Returns the measurement in a 3D view, without its text. `seenAt` projects patient points; it returns
/// nothing for points behind the eye. There are no lines if its kind is not shown in 3D or a part lies behind
/// the eye. Surfaces in front do not hide it.
DrawnMeasurement drawnInScene(const Measurement& measurement,
                              const std::function<std::optional<QPointF>(glm::dvec3 pPatient)>& seenAt,
                              bool selected);

/// Calls placeLegend() and placeTexts(), avoiding the texts written over the picture.
void placeBeside(const Overlays& written, std::vector<DrawnMeasurement>& drawn, const QRectF& area,
                 const QFont& font);

/// In small views with several texts, gives each a letter and a line in a legend at an edge of `area`,
/// outside `taken`. Without room the texts are kept. Equal input gives equal letters and positions.
void placeLegend(std::vector<DrawnMeasurement>& drawn, const QRectF& area, const std::vector<QRectF>& taken,
                 const QFontMetricsF& metrics);
inline constexpr double smallView = 280;  ///< logical pixels of its shorter side

/// Places texts where the user has put them, the others beside their shapes inside `area`. They avoid shapes,
/// `taken` and other texts if possible, else only `taken` and texts. They overlap texts only if the area is
/// full. Equal shapes and texts get equal positions.
void placeTexts(std::vector<DrawnMeasurement>& drawn, const QRectF& area, const std::vector<QRectF>& taken,
                const QFontMetricsF& metrics);

/// The part of a measurement under a point. The last drawn comes first; handles come before lines and texts.
struct DrawnHit {
  const DrawnMeasurement* drawn = nullptr;
  MeasurementPart part = MeasurementPart::line;
  std::size_t handle = 0;
};
std::optional<DrawnHit> hitAt(const std::vector<DrawnMeasurement>& drawn, QPointF p);

void paintMeasurements(QPainter& painter, const std::vector<DrawnMeasurement>& drawn);

}  // namespace volumen
