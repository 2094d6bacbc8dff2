#pragma once

#include <vector>

#include "io/report.h"
#include "io/study/suv.h"
#include "results/numbers/segment_report.h"

namespace volumen {

/// Returns the numbers of a segment of a DICOM segmentation as a measurement group (PS3.16 TID 1411): volume
/// in ml, and mean, standard deviation, minimum and maximum of its values in `scale`. `sources` are the
/// images it was made on. The Error says why without the segment's name or full stop: it has no voxels, or
/// its volume is not known in ml.
Result<MeasurementGroup> reportedSegment(const SegmentReport& report, const std::string& segmentationUid,
                                         const std::vector<ReferencedPicture>& sources,
                                         const ValueScale& scale);

}  // namespace volumen
