#pragma once

#include "ui/features/workbench.h"

namespace volumen {

/// Shows a picture of a series (its number among them): as a slice where the series is on screen in slices,
/// else as a frame. One step.
void showPicture(Workbench& bench, const Series& series, int index);

/// Shows it as a frame in the view in focus, by a presentation state, or, where that is empty, as it was
/// shown there. One step of this name.
void showAsFrame(Workbench& bench, const QString& text, const Series& series, int index,
                 const DerivedKey& presentation);

/// Shown by a presentation state, or, where that is empty, as acquired; windows of before do not hold.
Workspace withPresentation(Workspace workspace, ViewId view, const DerivedKey& presentation);

}  // namespace volumen
