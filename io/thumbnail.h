#pragma once

#include <QImage>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"
#include "viewer/volume/volume.h"

namespace volumen {

struct Image;
struct Series;

/// The slice in the middle of a volume by its first window (`unit` of its values), as it is usually looked
/// at: anterior or superior on top. In square pixels, the longer side of `edge`.
QImage thumbnailOf(const Volume& volume, const std::string& unit, int edge);

/// The same of a series; DICOM's as acquired, of which one slice alone is read, and of series of frames the
/// one in the middle. An Error where it cannot be read.
Result<QImage> thumbnailOf(const Series& series, int edge, const CancelToken& cancel = {});

/// The frame in the middle of a picture as acquired, by its window.
Result<QImage> thumbnailOf(const Image& image, int edge);

}  // namespace volumen
