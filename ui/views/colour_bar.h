#pragma once

#include <QPainter>

#include "viewer/slice/colour_map.h"

namespace volumen {

/// A bar of a map's colours with the values of its ends beside them, upright at the left edge of an area.
void paintColourBar(QPainter& painter, const QRectF& area, ColourMap map, const Window& window,
                    const QString& unit);

}  // namespace volumen
