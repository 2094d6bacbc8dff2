#pragma once

#include <QStringList>

#include "ui/controller/segment_jobs.h"

namespace volumen {

/// The work that adds the segments of a file to those of a series, on the grid of its volume. They keep their
/// numbers, names, colours and codes where those are free. None loses a voxel: what overlaps the map that is
/// worked on goes to the first further one where it fits. `told` gets the sentences that are to be known,
/// once it is a step.
SegmentWork importOf(const QString& path, const Series& series, VolumePtr volume,
                     std::function<void(const QStringList& sentences)> told);

}  // namespace volumen
