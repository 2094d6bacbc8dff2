#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/files/picture_file.h"
#include "ui/workspace/segment_surfaces.h"
#include "viewer/segment/tissue_shown.h"

namespace volumen {

/// What is to be said of the segments of a picture in 3D.
struct SegmentsInPicture {
  std::vector<std::string> drawn;  ///< names, and opacities below 1
  TissueShown tissue{};            ///< of the volume itself
};

/// Of those that have voxels, and where the volume itself was shown.
SegmentsInPicture segmentsInPicture(std::span<const SegmentInScene> drawn, const TissueShown& tissue);

/// For the picture's file: "volumen-segments", a line each, where the picture draws surfaces;
/// "volumen-tissue" where the volume itself is not shown everywhere.
PictureText textOfSegments(const SegmentsInPicture& segments, bool areDrawn);

}  // namespace volumen
