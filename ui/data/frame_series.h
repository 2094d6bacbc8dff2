#pragma once

#include <vector>

#include "io/study/series.h"

namespace volumen {

struct Study;

/// The pictures of a study that are no volumes, as series of frames alone (Series::notVolume): one for each
/// series of a study, the frames of all its files in order; files without a series each for itself.
std::vector<Series> frameSeries(const Study& study);

/// How many frames can be shown as acquired; 0 where the format has none.
int frameCount(const Series& series);

/// Whether it has no other view than its frames: it is no volume, or one slice without a place.
bool opensAsFrames(const Series& series);

/// Whether planes across the slices and 3D pictures show something of it: four slices or more that fill the
/// space between them. Of localizers and single slices they do not.
bool isUsefulVolume(const Series& series);

/// Whether it holds X-ray pictures without a place from several sides, or of several views.
bool isOfProjections(const Series& series);

/// Whether the first view of it is its frames: opensAsFrames(), or it has frames and is no useful volume, or
/// isOfProjections().
bool opensAsPictures(const Series& series);

}  // namespace volumen
