#pragma once

#include <QImage>
#include <optional>
#include <string>

#include "app/open_volume.h"
#include "app/overlay_options.h"
#include "io/files/picture_file.h"
#include "viewer/slice/slice.h"

namespace volumen {

/// A slice in grey, and the window that made it so; with an overlay in colour.
struct SlicePicture {
  QImage image;
  std::string window;   ///< "LINEAR 40,400": function (PS3.3 C.11.2.1.3), centre, width
  std::string overlay;  ///< Overlay::words; empty: there is none
};

/// Draws a plane of an opened volume through a window, by default the volume's first, and an overlay over it
/// if there is one. The Error: the plane has too many pixels, or the command was cancelled.
Result<SlicePicture> slicePicture(const Opened& opened, const SlicePlane& plane,
                                  const std::optional<Window>& window, const std::optional<Overlay>& overlay,
                                  const CancelToken& cancel);

/// Returns the text entries of its PNG.
PictureText sliceText(const SlicePlane& plane, const SlicePicture& picture);

}  // namespace volumen
