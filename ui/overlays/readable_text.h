#pragma once

#include <QPainter>
#include <QString>

namespace volumen {

/// Writes a line over a picture, in the painter's font, with an outline against which it has a contrast of
/// 4.5:1 whatever lies below: dark, or light about dark letters. Letters of all scripts stand in one order
/// for letters and halo: that of a text from left to right.
void paintReadable(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour);

/// Writes lines into a place, as QPainter::drawText() does with these flags, with the outline alone.
void paintReadable(QPainter& painter, const QRectF& place, int flags, const QString& text,
                   const QColor& colour);

}  // namespace volumen
