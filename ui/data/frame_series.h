#pragma once

#include <vector>

#include "io/study.h"

namespace volumen {

/// The pictures of a study that are no volumes, as series of frames alone (Series::notVolume): one for each
/// series of a study, the frames of all its files in order; files without a series each for itself.
std::vector<Series> frameSeries(const Study& study);

/// How many frames can be shown as acquired; 0 where the format has none.
int frameCount(const Series& series);

/// Whether the first view of it is its frames: it is no volume, or one slice without a place.
bool opensAsFrames(const Series& series);

}  // namespace volumen
