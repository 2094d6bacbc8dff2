#pragma once

#include <QImage>

#include "io/study/warning.h"
#include "ui/overlays/overlays.h"
#include "ui/workspace/snapshot_request.h"

namespace volumen {

/// Writes over a picture that leaves the program, as large as suits its size. Works on any thread, once there
/// is a QGuiApplication.
void annotate(QImage& image, Overlays overlays);

/// The overlays that are only these warnings, each on a line of its own.
Overlays warningOverlays(const std::vector<Warning>& warnings);

/// What of a view's overlays is chosen for a picture, and the warnings, where they are.
Overlays chosenOverlays(const Overlays& all, const Annotations& chosen, const std::vector<Warning>& warnings);

}  // namespace volumen
