#pragma once

#include <QString>

#include "ui/workspace/session.h"

namespace volumen {

// The target of the Segments panel, its actions and its tool: the series of the 3D view in focus.

/// Returns a sentence why the series cannot have segments; empty if it can.
QString whyNoSegments(const Session& session);
/// Returns its current map of segments on the grid of its volume. Null if there is none or whyNoSegments()
/// applies.
const SegmentMap* segmentsShown(const Session& session);
/// Returns all its maps on that grid, by number; empty if segmentsShown() is null. They point into the
/// present workspace; copy what must outlive it.
std::vector<const SegmentMap*> allSegmentsShown(const Session& session);
std::vector<SegmentMap> copiesOf(const std::vector<const SegmentMap*>& maps);
/// Returns the current segment of segmentsShown(), or null.
const Segment* segmentShown(const Session& session);
/// Returns the segment of segmentsShown() with this number; if that is the current one or none, the first
/// other one. Null if there is no other one.
const Segment* otherSegmentShown(const Session& session, int number);
/// Returns a sentence that the Segments panel belongs to another series than the one clicked.
QString isOfOtherSeries();
/// Returns a sentence why a view of this series cannot edit the segments of the panel; empty if it can.
QString whyNotIn(const Session& session, const SeriesKey& series);
/// Returns a sentence that there is no other segment to work with. With several maps it names the map.
QString noOtherSegment(const Session& session);
/// Returns a sentence why the current segment cannot be changed; empty if it can.
QString whyNotChanged(const Session& session);
/// Returns the unmasked volume if it is in memory. Requires whyNoSegments() to be empty.
VolumePtr wholeVolume(const Session& session);

}  // namespace volumen
