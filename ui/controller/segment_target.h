#pragma once

#include <QString>

#include "ui/workspace/session.h"

namespace volumen {

// What the panel of segments, its actions and the tool work on: the series of the 3D view in focus.

/// Why it can have no segments, a sentence; empty: it can.
QString whyNoSegments(const Session& session);
/// Its segments on the grid of its volume; null: none, or whyNoSegments().
const SegmentMap* segmentsShown(const Session& session);
/// The one of them that is worked on; null: there is none.
const Segment* segmentShown(const Session& session);
/// Why that cannot be changed, a sentence; empty: it can.
QString whyNotChanged(const Session& session);
/// All of its volume, what was cut away included, where that is in memory. Only without whyNoSegments().
VolumePtr wholeVolume(const Session& session);

}  // namespace volumen
