#pragma once

#include <functional>
#include <optional>

#include "ui/controller/segment_jobs.h"

namespace volumen {

/// The work that moves the segment that is worked on, which there must be, into the map of a number of its
/// series; none: into a new one. It takes its voxels from the segments there: `told` gets the sentence that
/// says how many, once it is a step, where it took any.
SegmentWork moveOf(const Session& session, std::optional<int> map,
                   std::function<void(const QString& sentence)> told);

}  // namespace volumen
