#pragma once

#include <memory>
#include <optional>

#include "io/study/series_key.h"
#include "results/series/loaded_series.h"
#include "viewer/measure/frame_measure.h"
#include "viewer/slice/frame.h"
#include "viewer/slice/plane.h"
#include "viewer/slice/presentation.h"
#include "viewer/slice/pyramid.h"

namespace volumen {

/// Identifies a frame: its series, and its index there from 0.
struct FrameKey {
  SeriesKey series;
  int index = 0;
  std::string presentation{};  ///< file of the presentation state it is shown by; empty: none
  auto operator<=>(const FrameKey&) const = default;
};

/// A frame in memory as flat views draw it: a series of one slice, so that it is handled like any other.
/// Without a position in the patient, its first pixel is the origin. Rows then run along x, columns along
/// y, and pixels have the size in PixelSize.
struct LoadedFrame {
  FrameKey key;
  LoadedSeriesPtr slice;               ///< its values; for colour frames the red channel
  VolumePtr green, blue;               ///< null: the frame is grey
  VolumePtr overlays, shutter;         ///< 1 where they draw or hide, else 0; null: none
  std::vector<Pyramid> pyramids;       ///< of each of these volumes
  float shutterGrey = 0;               ///< shown in place of hidden pixels, 0 black .. 1 white
  std::vector<NamedGrey> greys;        ///< its own
  std::vector<NamedGrey> seriesGreys;  ///< those of the series' middle frame; empty: it uses its own
  PixelSize pixel;
  std::vector<UltrasoundRegion> regions;
  std::string rowSide, columnSide;       ///< as in Frame
  std::optional<FramePresentation> how;  ///< from the presentation state; empty: as acquired
  std::vector<std::string> warnings;

  bool colour() const { return green != nullptr; }
  const VoxelGeometry& geometry() const { return slice->volume->geometry(); }
  /// Returns the bytes of all pixels held, including reduced copies.
  std::size_t bytes() const;
  /// Returns one of its volumes, or the reduced copy that a plane is drawn from in its place.
  const Volume& seenOn(const SlicePlane& plane, const VolumePtr& volume) const;
};

using LoadedFramePtr = std::shared_ptr<const LoadedFrame>;

/// Makes a frame of a series ready for display under `key`. Returns an Error if its geometry is invalid.
Result<LoadedFramePtr> shownFrame(const Series& series, const FrameKey& key, Frame frame,
                                  std::optional<FramePresentation> how = {},
                                  std::vector<NamedGrey> seriesGreys = {});

/// Returns the plane that shows a slice as acquired: rows to the right, columns down, otherwise as
/// planeAlong().
SlicePlane framePlane(const VoxelGeometry& slice);

/// Returns a name for a frame of a series (from 0) that does not depend on the other frames.
ShapeFrame frameNamed(const Series& series, int frame);
/// Returns the index of the named frame; empty if the series does not hold it.
std::optional<int> frameMeant(const Series& series, const ShapeFrame& name);

/// Returns a frame as measurements need it.
FramePixels pixelsOf(const LoadedFrame& frame);

}  // namespace volumen
