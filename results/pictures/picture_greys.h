#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/presentation.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Pictures of one series.
struct SeriesPictures {
  Series series;
  std::vector<int> indices;  ///< of its frames, ascending; never empty
};

/// Returns how pictures with this mapping are shown through another window. LINEAR is for widths from 1 on
/// (slices.md 3); narrower ones follow LINEAR_EXACT.
GreyMapping throughWindow(GreyMapping grey, const Window& window);

/// Returns references to pictures of a series by index, each image once with its frames.
std::vector<ReferencedPicture> picturesAt(const Series& series, const std::vector<int>& indices);

/// How pictures show their values: a presentation, and the first picture.
struct PictureGreys {
  Presentation presentation;       ///< pictures, values, windows and inversion
  Frame first;                     ///< without values
  std::vector<std::string> notes;  ///< sentences for the user
};

/// Reads pictures and how they show their values: through `window`, by default through their own windows and
/// lookup tables. Pictures of different rescales (PET) have a window each, in stored values. The Error: a
/// picture cannot be read or is in colour, or pictures are not alike, so that one presentation is not enough.
Result<PictureGreys> greysOfPictures(const SeriesPictures& chosen, const std::optional<Window>& window,
                                     const CancelToken& cancel);

}  // namespace volumen
