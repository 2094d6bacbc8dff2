#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// The acquired picture that a plane shows, by its index in the series. Empty if the plane is a slab, is not
/// parallel to the slices or lies on none. With `interpolated` it lies on a slice made from its neighbours.
struct PictureSeen {
  std::optional<int> index;
  bool interpolated = false;
};

/// Returns the picture that `plane` shows. `drawn` is the volume's grid, which differs from that of unevenly
/// spaced slices.
PictureSeen pictureSeen(const Series& series, const VoxelGeometry& drawn, const SlicePlane& plane);

/// Returns the k index of slice `index` on the drawn grid; empty if it lies beyond the end or was
/// interpolated.
std::optional<int> drawnSlice(const Series& series, int index);

/// Returns the key image of picture `index` (from 0) of a series, without a window; empty if its file has no
/// UID.
std::optional<KeyImage> keyImageOf(const Series& series, int index);

/// Returns the indices of the marked pictures of a series, ascending.
std::vector<int> keyImagesOf(const Workspace& workspace, const Series& series);

/// Returns whether the picture is marked, with any window.
bool isKeyImage(const Workspace& workspace, const KeyImage& image);

/// Marks an unmarked picture and unmarks a marked one.
Workspace withKeyImageToggled(Workspace workspace, const KeyImage& image);

}  // namespace volumen
