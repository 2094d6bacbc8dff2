#pragma once

#include <QImage>

#include "viewer/slice/presentation.h"

namespace volumen {

/// Draws the graphics and texts of a presentation state over the displayed picture, layer by layer in their
/// recommended greys or colours. Needs a QGuiApplication. What lies far outside the picture is left out.
void paintGraphics(QImage& image, const FramePresentation& how, const PresentedGrid& grid);

}  // namespace volumen
