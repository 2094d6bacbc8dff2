#pragma once

#include <QPainter>
#include <functional>
#include <vector>

#include "viewer/slice/presentation.h"

namespace volumen {

/// Where a position of an annotation lies, in pixels of the painter.
using AnnotationPlaces = std::function<QPointF(glm::dvec2 position, AnnotationUnits units)>;

/// Draws the graphics and texts of a presentation state, layer by layer in their recommended greys or
/// colours, in the painter's font. What lies far outside the picture is left out. A text that belongs to no
/// place of the picture, but to the display, and would touch what stands at `taken` moves down until it is
/// free.
void paintGraphics(QPainter& painter, const FramePresentation& how, const AnnotationPlaces& places,
                   std::vector<QRectF> taken = {});

/// The same over the displayed picture, pixel for pixel, letters as large as suits its height. Needs a
/// QGuiApplication.
void paintGraphics(QImage& image, const FramePresentation& how, const PresentedGrid& grid);

}  // namespace volumen
