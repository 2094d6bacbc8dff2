#pragma once

#include <QPainter>
#include <QString>

namespace volumen {

/// Writes a line over a picture in the painter's font. The outline has a contrast of 4.5:1 on any background:
/// dark, or light for dark letters. All scripts run from left to right, so that letters and halo match.
void paintReadable(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour);

/// Writes lines into a rectangle like QPainter::drawText() with these flags, with only the outline.
void paintReadable(QPainter& painter, const QRectF& place, int flags, const QString& text,
                   const QColor& colour);

/// Returns the ISO date with which a text begins, such as that of a study; empty if there is none. Half a
/// date may be taken for another one, so it is never elided.
QString leadingDate(const QString& text);

}  // namespace volumen
