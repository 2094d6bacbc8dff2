#pragma once

#include <vector>

#include "io/study/series.h"

namespace volumen {

struct Study;

/// Returns the pictures of a study that are no volumes as series of frames (Series::notVolume), one for each
/// of its series. Frames of all files are in PictureOrder, then by SOPInstanceUID. Files without a series
/// make one each. The size of a series is that of its largest columns and rows.
std::vector<Series> frameSeries(const Study& study);

/// Returns the same as older session files have them: ordered by path, without pictures of stacks, as large
/// as the first. The id differs only if the series does.
std::vector<Series> frameSeriesOfPaths(const Study& study);

/// Returns how many frames can be shown as acquired; 0 if the format has none.
int frameCount(const Series& series);

/// Returns whether frames are its only view: it is no volume, or one slice without a position.
bool opensAsFrames(const Series& series);

/// Returns whether planes across the slices and 3D pictures of it are useful: four or more slices fill the
/// space between them. Those of localizers and single slices are not.
bool isUsefulVolume(const Series& series);

/// Returns whether it holds several X-ray pictures without a position: of several files, sides or views.
bool isOfProjections(const Series& series);

/// Returns whether its pictures are made one by one, each with a window of its own. These are X-ray pictures,
/// ultrasound and others without a position. Slices of tomosynthesis and rotating C-arms have one.
bool areMadeOneByOne(const Series& series);

/// Returns whether its first view is frames: opensAsFrames(), or it has frames and is no useful volume,
/// isOfProjections() or areMadeOneByOne().
bool opensAsPictures(const Series& series);

/// Returns the first of `frames` with more pictures than a series that opensAsPictures(). Null if there is
/// none, or the series opens as a volume.
const Series* largerStack(const Series& series, const std::vector<Series>& frames);

}  // namespace volumen
