#pragma once

#include <QStringList>

#include "ui/controller/segment_jobs.h"

namespace volumen {

/// Returns the work that adds the segments of a file to a series, on the grid of its volume. They keep free
/// numbers, names, colours and codes. No segment loses voxels: those that overlap the current map go to the
/// first further map they fit in. `told` receives sentences for the user once it is an undo step.
SegmentWork importOf(const QString& path, const Series& series, VolumePtr volume,
                     std::function<void(const QStringList& sentences)> told);

}  // namespace volumen
