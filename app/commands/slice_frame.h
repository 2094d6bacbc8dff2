#pragma once

#include <optional>
#include <string>

#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Options of `slice --plane frame`.
struct FrameOptions {
  std::string path, series, output;
  std::optional<int> index;      ///< if empty, the first frame (that the presentation state references)
  std::optional<Window> window;  ///< if empty, that of the presentation state, else the file's first
  std::string presentation;      ///< file, or its number in `info`; empty: as acquired
  bool graphics = true;          ///< the presentation state's graphics, drawn into .png
};

/// Writes one image pixel for pixel: as acquired (slices.md 2), without overlays and shutters, or as a
/// presentation state displays it. It is of the requested series or image, else of the series with most
/// voxels or of the first image. Returns the exit status.
int sliceFrame(const FrameOptions& options, const CancelToken& cancel);

}  // namespace volumen
