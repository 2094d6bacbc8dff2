#pragma once

#include <optional>

#include "app/exports/chosen_pictures.h"
#include "io/presentation.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// How pictures show their values: a presentation, and the first picture.
struct PictureGreys {
  Presentation presentation;  ///< pictures, values, windows and inversion
  Frame first;
  std::vector<std::string> notes;  ///< sentences for the user
};

/// Reads pictures and how they show their values: through `window`, by default through their own windows and
/// lookup tables. Pictures of different rescales (PET) have a window each, in stored values. The Error: a
/// picture cannot be read or is in colour, or pictures are not alike, so that one presentation is not enough.
Result<PictureGreys> greysOfPictures(const ChosenPictures& chosen, const std::optional<Window>& window,
                                     const CancelToken& cancel);

}  // namespace volumen
