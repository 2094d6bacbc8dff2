#pragma once

#include <QImage>

#include "io/study/warning.h"
#include "results/pictures/overlays.h"

namespace volumen {

/// Writes overlays on an exported picture, in a size that suits it. Works on any thread if a QGuiApplication
/// exists.
void annotate(QImage& image, Overlays overlays);

/// Returns overlays of only these warnings, one a line.
Overlays warningOverlays(const std::vector<Warning>& warnings);

}  // namespace volumen
