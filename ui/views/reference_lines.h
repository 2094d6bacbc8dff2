#pragma once

#include <QLineF>
#include <QPainter>
#include <vector>

#include "ui/views/flat_view.h"

namespace volumen {

/// The intersection of a flat view with the plane of another view on screen.
struct ReferenceLine {
  ViewId other;
  FlatView::StackPart part;
  QLineF line;  ///< visible part, logical pixels
  /// Colour of the other plane. Frames have the colour of the closest standard plane of the patient.
  QRgb colour;
  QString name{};  ///< "Axial"
};

/// Paints thin dashed lines, first and last slices dotted. Each has its name where there is room.
void paintReferenceLines(QPainter& painter, const std::vector<ReferenceLine>& lines, QRect view);

}  // namespace volumen
