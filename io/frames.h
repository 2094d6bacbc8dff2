#pragma once

#include "io/presentation.h"
#include "viewer/slice/frame.h"

namespace volumen {

struct Image;
struct Series;

/// Frame `index` (from 0) of a picture, as acquired (slices.md 2): values or colours, the file's windows,
/// overlays, shutter, regions. Where the file has no window the default is P0.1 .. P99.9 of this frame
/// without padding. An Error names the file and why: damaged, or too large (framePixelLimit()). What alone
/// cannot be shown (an overlay, a LUT, a shutter) is left out with a sentence in `warnings`.
Result<Frame> loadFrame(const Image& image, int index);

/// The frame that is slice `index` (from 0) of a DICOM series.
Result<Frame> loadFrame(const Series& series, int index);

/// A frame with the values, greys and shutter of a presentation state, and how it is to be shown.
struct PresentedFrame {
  Frame frame;
  FramePresentation how;
};

/// The same frames as a presentation state has them shown. An Error also where it refers to other pictures
/// alone, or displays no part of this one or too large an area (framePixelLimit()).
Result<PresentedFrame> loadFrame(const Image& image, int index, const Presentation& presentation);
Result<PresentedFrame> loadFrame(const Series& series, int index, const Presentation& presentation);

}  // namespace volumen
