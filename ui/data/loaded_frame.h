#pragma once

#include <memory>
#include <optional>

#include "ui/data/loaded_series.h"
#include "ui/data/series_key.h"
#include "viewer/slice/frame.h"
#include "viewer/slice/plane.h"
#include "viewer/slice/presentation.h"

namespace volumen {

/// Names a frame: its series, and its number there from 0.
struct FrameKey {
  SeriesKey series;
  int index = 0;
  std::string presentation{};  ///< the file of the presentation state it is shown by; empty: none
  auto operator<=>(const FrameKey&) const = default;
};

/// A frame in memory, as flat views draw it: a series of one slice, so that it is cut, moved and read like
/// any other. Where it has no place in the patient its first pixel is the origin, rows run along x, columns
/// along y, and a pixel is as large as PixelSize says.
struct LoadedFrame {
  FrameKey key;
  LoadedSeriesPtr slice;               ///< its values; of colour its red
  VolumePtr green, blue;               ///< null: grey
  VolumePtr overlays, shutter;         ///< 1 where they draw or hide, else 0; null: none
  float shutterGrey = 0;               ///< what the shutter hides behind, 0 black .. 1 white
  std::vector<NamedGrey> greys;        ///< its own
  std::vector<NamedGrey> seriesGreys;  ///< those of the middle frame of its series; empty: it has its own
  PixelSize pixel;
  std::vector<UltrasoundRegion> regions;
  std::string rowSide, columnSide;       ///< as Frame has them
  std::optional<FramePresentation> how;  ///< as the presentation state has it; none: as acquired
  std::vector<std::string> warnings;

  bool colour() const { return green != nullptr; }
  const VoxelGeometry& geometry() const { return slice->volume->geometry(); }
  /// Of all pixels held.
  std::size_t bytes() const;
};

using LoadedFramePtr = std::shared_ptr<const LoadedFrame>;

/// Makes a frame of a series ready to be shown. `key` names it. An Error where its geometry makes no sense.
Result<LoadedFramePtr> shownFrame(const Series& series, const FrameKey& key, Frame frame,
                                  std::optional<FramePresentation> how = {},
                                  std::vector<NamedGrey> seriesGreys = {});

/// The plane that shows a slice as it was acquired: its rows to the right, its columns downwards; else as
/// planeAlong().
SlicePlane framePlane(const VoxelGeometry& slice);

}  // namespace volumen
