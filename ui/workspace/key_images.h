#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// Which picture as acquired a plane shows, by its number in the series; none where it is not along the
/// slices, on none of them, a slab, or, with `interpolated`, on a slice that was made of its neighbours.
struct PictureSeen {
  std::optional<int> index;
  bool interpolated = false;
};

/// `drawn`: the grid of the volume, which differs from that of the slices where these are uneven.
PictureSeen pictureSeen(const Series& series, const VoxelGeometry& drawn, const SlicePlane& plane);

/// Where slice `index` of a series lies along k of the grid that is drawn; none: beyond its end, or
/// interpolated.
std::optional<int> drawnSlice(const Series& series, int index);

/// The mark that picture `index` (from 0) of a series has or would have, without a window; none where its
/// file has no UID.
std::optional<KeyImage> keyImageOf(const Series& series, int index);

/// The pictures of a series that are marked, by their numbers there: ascending.
std::vector<int> keyImagesOf(const Workspace& workspace, const Series& series);

/// Whether that picture is marked, by whatever window.
bool isKeyImage(const Workspace& workspace, const KeyImage& image);

/// Marked where it was not, and the other way round.
Workspace withKeyImageToggled(Workspace workspace, const KeyImage& image);

}  // namespace volumen
