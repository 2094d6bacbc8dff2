#pragma once

#include <QImage>

#include "io/study/warning.h"
#include "ui/overlays/overlays.h"
#include "ui/workspace/snapshot_request.h"

namespace volumen {

/// Writes overlays on an exported picture, in a size that suits it. Works on any thread if a QGuiApplication
/// exists.
void annotate(QImage& image, Overlays overlays);

/// Returns overlays of only these warnings, one a line.
Overlays warningOverlays(const std::vector<Warning>& warnings);

/// Returns the overlays of a view that are chosen for a picture, and the warnings among them.
Overlays chosenOverlays(const Overlays& all, const Annotations& chosen, const std::vector<Warning>& warnings);

}  // namespace volumen
