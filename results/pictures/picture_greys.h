#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/presentation.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Chosen pictures of one series.
struct SeriesPictures {
  Series series;
  std::vector<int> indices;  ///< frame indices, ascending; never empty
};

/// Returns `grey` with another window and without its lookup table. LINEAR requires widths of at least 1
/// (slices.md 3), so narrower windows become LINEAR_EXACT.
GreyMapping throughWindow(GreyMapping grey, const Window& window);

/// Returns references to pictures of a series by frame index. Each image is listed once, with its frames.
std::vector<ReferencedPicture> picturesAt(const Series& series, const std::vector<int>& indices);

/// Says how pictures show their values.
struct PictureGreys {
  Presentation presentation;       ///< pictures, values, windows and inversion
  Frame first;                     ///< the first picture, without values
  std::vector<std::string> notes;  ///< whole sentences for the user
};

/// Reads how pictures show their values: through `window`, or by default through their own windows and
/// lookup tables. If rescales differ (PET), each picture has its own window in stored values. Returns an
/// Error if a picture cannot be read or is in colour, or if the pictures differ too much for one
/// presentation.
Result<PictureGreys> greysOfPictures(const SeriesPictures& chosen, const std::optional<Window>& window,
                                     const CancelToken& cancel);

}  // namespace volumen
