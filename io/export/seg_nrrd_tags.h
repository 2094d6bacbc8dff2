#pragma once

#include <string>

#include "viewer/segment/segment.h"

namespace volumen {

/// Returns SegmentN_Tags of a segmentation of 3D Slicer ("key:value|" each); for a segment with a type this
/// is its TerminologyEntry (Slicer, Docs/developer_guide/modules/segmentations.md).
std::string tagsOf(const Segment& segment);

/// Sets category, type, region and their modifiers from SegmentN_Tags, as far as they are present.
void readTags(const std::string& tags, Segment& segment);

}  // namespace volumen
