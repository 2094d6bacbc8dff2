#pragma once

#include <QFontMetricsF>
#include <QPainter>
#include <QPolygonF>
#include <QStringList>
#include <functional>
#include <optional>
#include <vector>

#include "ui/overlays/overlays.h"
#include "ui/tools/tool.h"
#include "ui/workspace/measurement.h"

namespace volumen {

/// A measurement as it is seen in a view. Logical pixels of the view.
struct DrawnMeasurement {
  int id = 0;
  ShapeKind kind = ShapeKind::length;
  bool whole = false;  ///< all of it lies in a flat view's plane; else what the plane cuts
  bool selected = false;
  std::vector<QPolygonF> lines;  ///< a line of one point is a mark
  struct Handle {
    std::size_t index = 0;  ///< of handlesOf()
    QPointF at;
  };
  std::vector<Handle> handles;        ///< of the selected one
  QPointF middle;                     ///< of the shape
  std::optional<QPointF> textMiddle;  ///< where the user has put the text
  QStringList text;
  QRectF textRect;    ///< around it; empty: there is no text, or no room
  QString letter;     ///< stands there in place of the text, which the legend has; empty: there is no legend
  QString legend;     ///< its line there
  QRectF legendRect;  ///< around that
};

/// The measurement in a view of this plane (device pixels); without lines where nothing is to be seen of it.
/// Without its text.
DrawnMeasurement drawnMeasurement(const Measurement& measurement, const SlicePlane& plane,
                                  const VoxelGeometry& geometry, double pixelRatio, bool selected);

/// The measurement in a 3D view, where places in the patient are seen at `seenAt` (none: behind the eye);
/// without lines where its kind is not seen there, or part of it lies behind the eye. What is in front of it
/// does not hide it. Without its text.
DrawnMeasurement drawnInScene(const Measurement& measurement,
                              const std::function<std::optional<QPointF>(glm::dvec3 pPatient)>& seenAt,
                              bool selected);

/// placeLegend() and placeTexts() beside what is written over the picture.
void placeBeside(const Overlays& written, std::vector<DrawnMeasurement>& drawn, const QRectF& area,
                 const QFont& font);

/// Where a view is small and several have a text: gives each a letter and a line in a legend, at an edge of
/// `area` where nothing is `taken`; which depends on nothing else. Where there is no room they keep their
/// texts.
void placeLegend(std::vector<DrawnMeasurement>& drawn, const QRectF& area, const std::vector<QRectF>& taken,
                 const QFontMetricsF& metrics);
inline constexpr double smallView = 280;  ///< logical pixels of its shorter side

/// Gives every text its place inside `area`: where the user put it, else beside its shape, touching neither
/// any shape nor `taken` nor another text, where there is such a place; else it may lie over others' shapes,
/// and only where the area is full over other texts. The same shapes and texts have the same places.
void placeTexts(std::vector<DrawnMeasurement>& drawn, const QRectF& area, const std::vector<QRectF>& taken,
                const QFontMetricsF& metrics);

/// What of them lies under a point, the last drawn first; handles before lines and texts.
struct DrawnHit {
  const DrawnMeasurement* drawn = nullptr;
  MeasurementPart part = MeasurementPart::line;
  std::size_t handle = 0;
};
std::optional<DrawnHit> hitAt(const std::vector<DrawnMeasurement>& drawn, QPointF p);

void paintMeasurements(QPainter& painter, const std::vector<DrawnMeasurement>& drawn);

}  // namespace volumen
