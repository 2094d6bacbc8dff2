#pragma once

#include <QImage>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"
#include "viewer/volume/volume.h"

namespace volumen {

struct Frame;
struct Image;
struct Series;

/// Returns the middle slice of a volume in its first window (`unit` is that of its values). The view is the
/// usual one: anterior or superior on top. Pixels are square; the longer side is `edge`.
QImage thumbnailOf(const Volume& volume, const std::string& unit, int edge);

/// Returns the thumbnail of a series. For DICOM it reads only one slice as acquired; for a series of frames
/// the middle one. The Error: it cannot be read.
Result<QImage> thumbnailOf(const Series& series, int edge, const CancelToken& cancel = {});

/// Returns the thumbnail of a series from its middle frame, which may be reduced (loadSmallFrame()).
QImage thumbnailOf(const Frame& middle, const Series& series, int edge);

/// Returns the middle frame of an image as acquired, in its window.
Result<QImage> thumbnailOf(const Image& image, int edge);

}  // namespace volumen
