#pragma once

#include <QString>
#include <string>

#include "ui/workspace/segment_map.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Writes the segments of a map that has labels, as the ending of `path` says. The file appears whole or not
/// at all; an Error names it, and the endings that there are where it has none of them.
Status exportSegments(const std::string& path, const SegmentMap& map, const CancelToken& cancel = {});

/// What a file dialog offers: "Segmentations (*.seg.nrrd)".
QString exportFilters();
/// The ending where none is typed, without its first full stop: "seg.nrrd".
QString usualExportEnding();

}  // namespace volumen
