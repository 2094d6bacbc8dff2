#pragma once

#include <optional>
#include <string>

#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What `slice --plane frame` is asked for.
struct FrameOptions {
  std::string path, series, output;
  int index = 0;
  std::optional<Window> window;  ///< none: the file's first
};

/// Writes one picture as acquired (slices.md 2), pixel for pixel, without overlays and shutters: of the
/// series or image that is meant, else of the series with most voxels or of the first image. Returns the exit
/// status.
int sliceFrame(const FrameOptions& options, const CancelToken& cancel);

}  // namespace volumen
