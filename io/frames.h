#pragma once

#include "io/presentation.h"
#include "io/study/progress.h"
#include "viewer/slice/frame.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Image;
struct Series;

/// Reads frame `index` (from 0) of an image as acquired (slices.md 2): values or colours, the file's windows,
/// overlays, shutter, regions. Without a window in the file, the default is P0.1 .. P99.9 of this frame
/// without padding. The Error names the file and the reason: damaged, or too large (framePixelLimit()). Parts
/// that cannot be shown (an overlay, a LUT, a shutter) are left out with a sentence in `warnings`.
Result<Frame> loadFrame(const Image& image, int index);

/// Reads the frame of slice `index` (from 0) of a DICOM series. `progress` reports the bytes of its pixels.
Result<Frame> loadFrame(const Series& series, int index, const Progress& progress = {});

/// Returns frames of a DICOM series by index, ascending, as loadFrame() does, but without values, colours,
/// overlays and shutter: nothing is decoded unless greys follow from values. Frames in colour have no greys.
/// After `cancel`, frames are missing.
Result<std::vector<Frame>> loadFrameGreys(const Series& series, const std::vector<int>& indices,
                                          const CancelToken& cancel = {});

/// Reads a frame for a picture whose longer side has `edge` pixels. Large grey frames are reduced to means of
/// blocks, no smaller than that picture needs, without overlays and shutter.
Result<Frame> loadSmallFrame(const Image& image, int index, int edge);
Result<Frame> loadSmallFrame(const Series& series, int index, int edge);

/// A frame with the values, grey scales and shutter of a presentation state, and its display parameters.
struct PresentedFrame {
  Frame frame;
  FramePresentation how;
};

/// Reads a frame as a presentation state displays it. Also an Error: it refers only to other images, or
/// displays no part of this one or too large an area (framePixelLimit()).
Result<PresentedFrame> loadFrame(const Image& image, int index, const Presentation& presentation);
Result<PresentedFrame> loadFrame(const Series& series, int index, const Presentation& presentation,
                                 const Progress& progress = {});

}  // namespace volumen
