#pragma once

#include "ui/features/workbench.h"

namespace volumen {

/// Shows picture `index` of a series, as a slice if slices of the series are on screen, else as a frame.
/// Makes one undo step.
void showPicture(Workbench& bench, const Series& series, int index);

/// Shows picture `index` as a frame in the view in focus, by a presentation state or, if that is empty, as
/// last shown there. Makes one undo step named `text`.
void showAsFrame(Workbench& bench, const QString& text, const Series& series, int index,
                 const DerivedKey& presentation);

/// Applies a presentation state to a view, or shows it as acquired if that is empty. Discards earlier
/// windows.
Workspace withPresentation(Workspace workspace, ViewId view, const DerivedKey& presentation);

}  // namespace volumen
