#pragma once

#include <QString>

#include "ui/data/loaded_frame.h"

namespace volumen {

/// What the pixels of a frame measure: "0.175 mm a pixel, at detector", "0.5 x 0.4 mm a pixel"; "mm in
/// regions, else px" of an ultrasound; "not calibrated: px" where they measure nothing.
QString pixelSizeText(const LoadedFrame& frame);

/// Whether lengths in a frame are mm of anything.
inline bool hasMm(const LoadedFrame& frame) { return frame.pixel.kind != PixelSizeKind::unknown; }

/// Where a pixel lies (column, row; from 0): "10, 20 px", and in mm from the first pixel where that
/// is true, with the word for what these mm are; in a region of an ultrasound picture from its corner.
QString pixelPlaceText(const LoadedFrame& frame, glm::ivec2 pixel);

/// The value of a pixel: "59 HU", "R 4 G 186 B 86".
QString pixelValueText(const LoadedFrame& frame, glm::ivec2 pixel);

}  // namespace volumen
