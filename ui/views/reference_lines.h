#pragma once

#include <QLineF>
#include <QPainter>
#include <vector>

#include "ui/views/flat_view.h"

namespace volumen {

/// A plane of another view on screen in a flat view.
struct ReferenceLine {
  ViewId other;
  FlatView::StackPart part;
  QLineF line;     ///< as far as it is seen, logical pixels
  QRgb colour;     ///< of the other plane; of frames that of the patient's plane they are closest to
  QString name{};  ///< "Axial"
};

/// Thin and dashed, first and last slices dotted, each with its name where there is room for it.
void paintReferenceLines(QPainter& painter, const std::vector<ReferenceLine>& lines, QRect view);

}  // namespace volumen
