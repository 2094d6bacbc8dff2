#pragma once

#include <QString>

#include "ui/workspace/session.h"

namespace volumen {

// What the panel of segments, its actions and the tool work on: the series of the 3D view in focus.

/// Why it can have no segments, a sentence; empty: it can.
QString whyNoSegments(const Session& session);
/// Its map of segments that is worked on, on the grid of its volume; null: none, or whyNoSegments().
const SegmentMap* segmentsShown(const Session& session);
/// All its maps on that grid, by their numbers; none where segmentsShown() is null. They are those of the
/// workspace as it is: what outlives it is copied.
std::vector<const SegmentMap*> allSegmentsShown(const Session& session);
std::vector<SegmentMap> copiesOf(const std::vector<const SegmentMap*>& maps);
/// The one of segmentsShown() that is worked on; null: there is none.
const Segment* segmentShown(const Session& session);
/// That there is no other segment to work with, a sentence; of several maps which one has none.
QString noOtherSegment(const Session& session);
/// Why that cannot be changed, a sentence; empty: it can.
QString whyNotChanged(const Session& session);
/// All of its volume, what was cut away included, where that is in memory. Only without whyNoSegments().
VolumePtr wholeVolume(const Session& session);

}  // namespace volumen
