#pragma once

#include <vector>

#include "io/study/series.h"

namespace volumen {

struct Study;

/// The pictures of a study that are no volumes, as series of frames alone (Series::notVolume): one for each
/// series of a study, the frames of all its files by PictureOrder, then by SOPInstanceUID; files without a
/// series each for itself. Its size is that of its largest columns and rows.
std::vector<Series> frameSeries(const Study& study);

/// The same as older session files have them: in order of paths, without pictures of stacks, as large as the
/// first. Where nothing differs it is the same series; else its id is another.
std::vector<Series> frameSeriesOfPaths(const Study& study);

/// How many frames can be shown as acquired; 0 where the format has none.
int frameCount(const Series& series);

/// Whether it has no other view than its frames: it is no volume, or one slice without a place.
bool opensAsFrames(const Series& series);

/// Whether planes across the slices and 3D pictures show something of it: four slices or more that fill the
/// space between them. Of localizers and single slices they do not.
bool isUsefulVolume(const Series& series);

/// Whether it holds several X-ray pictures without a place: of several files, or sides, or views.
bool isOfProjections(const Series& series);

/// Whether its pictures are made one by one, each with a window of its own: X-ray pictures, ultrasound and
/// others that have no place as slices have (of tomosynthesis, or of rotating C-arms).
bool areMadeOneByOne(const Series& series);

/// Whether the first view of it is its frames: opensAsFrames(), or it has frames and is no useful volume, or
/// isOfProjections(), or areMadeOneByOne().
bool opensAsPictures(const Series& series);

/// The first of some series of frames that holds more pictures than one that opensAsPictures(); null: none
/// does, or it opens as a volume.
const Series* largerStack(const Series& series, const std::vector<Series>& frames);

}  // namespace volumen
