#pragma once

#include <QImage>
#include <optional>
#include <string>

#include "app/open_volume.h"
#include "io/files/picture_file.h"
#include "viewer/slice/slice.h"

namespace volumen {

/// A slice in grey, and the window that made it so.
struct SlicePicture {
  QImage image;
  std::string window;  ///< "LINEAR 40,400": function (PS3.3 C.11.2.1.3), centre, width
};

/// Draws a plane of an opened volume through a window, by default the volume's first. The Error: the plane
/// has too many pixels, or the command was cancelled.
Result<SlicePicture> slicePicture(const Opened& opened, const SlicePlane& plane,
                                  const std::optional<Window>& window, const CancelToken& cancel);

/// Returns the text entries of its PNG.
PictureText sliceText(const SlicePlane& plane, const SlicePicture& picture);

}  // namespace volumen
