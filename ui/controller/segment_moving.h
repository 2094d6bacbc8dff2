#pragma once

#include <functional>
#include <optional>

#include "ui/controller/segment_jobs.h"

namespace volumen {

/// Returns the work that moves the current segment, which must exist, into map number `map` of its series, or
/// into a new one. It takes voxels from the segments there. If so, `told` receives a sentence with their
/// number once it is an undo step.
SegmentWork moveOf(const Session& session, std::optional<int> map,
                   std::function<void(const QString& sentence)> told);

}  // namespace volumen
