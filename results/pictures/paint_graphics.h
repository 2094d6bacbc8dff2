#pragma once

#include <QPainter>
#include <functional>
#include <vector>

#include "viewer/slice/presentation.h"

namespace volumen {

/// Maps a position of an annotation to pixels of the painter.
using AnnotationPlaces = std::function<QPointF(glm::dvec2 position, AnnotationUnits units)>;

/// Draws the graphics and texts of a presentation state in the painter's font. Layers are drawn in order, in
/// their recommended greys or colours; what lies far outside the picture is left out. Texts positioned
/// relative to the display move down until they do not touch `taken`.
void paintGraphics(QPainter& painter, const FramePresentation& how, const AnnotationPlaces& places,
                   std::vector<QRectF> taken = {});

/// Draws the same over the displayed picture, pixel for pixel, with letters sized for its height. Needs a
/// QGuiApplication.
void paintGraphics(QImage& image, const FramePresentation& how, const PresentedGrid& grid);

}  // namespace volumen
