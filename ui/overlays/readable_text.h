#pragma once

#include <QPainter>
#include <QString>

namespace volumen {

/// Writes a line over a picture, in the painter's font, with a dark halo that makes it readable on white as
/// on black. Letters of all scripts stand in one order for letters and halo: that of a text from left to
/// right.
void paintReadable(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour);

}  // namespace volumen
