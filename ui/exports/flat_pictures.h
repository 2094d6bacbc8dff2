#pragma once

#include "ui/exports/picture_maker.h"

namespace volumen {

class Session;
class ViewGrid;

/// Stores in a stop what its picture needs of a session now: series in memory and preferences.
PictureStop heldNow(PictureStop stop, const Session& session);

/// Returns a session of its own with the workspace of a stop and what is held of it.
std::unique_ptr<Session> sessionOf(const PictureStop& stop);

/// Makes pictures of flat views in any size, over hidden views of the grid. Each has a session of its own,
/// independent of what is on screen. Frames and time points that are not in memory are read, and pictures
/// drawn, on other threads.
PictureMakerPtr flatPictures(const ViewGrid& grid, std::vector<PictureStop> stops, const PictureLook& look);

}  // namespace volumen
