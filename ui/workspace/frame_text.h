#pragma once

#include <QString>

#include "results/series/loaded_frame.h"

namespace volumen {

/// Returns the pixel size: "0.175 mm a pixel, at detector", "0.5 x 0.4 mm a pixel". Ultrasound reads "mm in
/// regions, else px", an uncalibrated frame "not calibrated: px".
QString pixelSizeText(const LoadedFrame& frame);

/// Returns whether lengths in a frame can be given in mm.
inline bool hasMm(const LoadedFrame& frame) { return frame.pixel.kind != PixelSizeKind::unknown; }

/// Returns a pixel's position (column, row; from 0), "10, 20 px". If known, adds the mm from the first pixel
/// with the word for these mm; in an ultrasound region, from its corner.
QString pixelPlaceText(const LoadedFrame& frame, glm::ivec2 pixel);

/// Returns the value of a pixel: "59 HU", "R 4 G 186 B 86".
QString pixelValueText(const LoadedFrame& frame, glm::ivec2 pixel);

}  // namespace volumen
