#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/files/picture_file.h"
#include "results/segments/segment_surfaces.h"
#include "viewer/segment/tissue_shown.h"

namespace volumen {

/// Texts about the segments in a 3D picture.
struct SegmentsInPicture {
  std::vector<std::string> drawn;  ///< names, and opacities below 1
  TissueShown tissue{};            ///< masking of the volume
};

/// Describes the drawn segments that have voxels, and the masking of the volume.
SegmentsInPicture segmentsInPicture(std::span<const SegmentInScene> drawn, const TissueShown& tissue);

/// Returns entries for the picture's file: "volumen-segments", one line per segment, if the picture draws
/// surfaces; "volumen-tissue" if the volume is masked.
PictureText textOfSegments(const SegmentsInPicture& segments, bool areDrawn);

}  // namespace volumen
