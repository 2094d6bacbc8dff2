#pragma once

#include <string>

#include "viewer/segment/segment.h"

namespace volumen {

/// SegmentN_Tags of a segmentation of 3D Slicer: "key:value|" each; of a segment with a type its
/// TerminologyEntry (Slicer, Docs/developer_guide/modules/segmentations.md).
std::string tagsOf(const Segment& segment);

/// Takes category, type, region and their modifiers from such tags, as far as they are there.
void readTags(const std::string& tags, Segment& segment);

}  // namespace volumen
