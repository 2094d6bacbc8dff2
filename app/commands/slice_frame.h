#pragma once

#include <optional>
#include <string>

#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What `slice --plane frame` is asked for.
struct FrameOptions {
  std::string path, series, output;
  std::optional<int> index;      ///< none: the first; of a presentation state the first that it refers to
  std::optional<Window> window;  ///< none: the file's first, or that of the presentation state
  std::string presentation;      ///< its file or its number in `info`; empty: as acquired
  bool graphics = true;          ///< of the presentation state, drawn into .png
};

/// Writes one picture as acquired (slices.md 2), pixel for pixel, without overlays and shutters, or as a
/// presentation state has it shown: of the series or image that is meant, else of the series with most voxels
/// or of the first image. Returns the exit status.
int sliceFrame(const FrameOptions& options, const CancelToken& cancel);

}  // namespace volumen
