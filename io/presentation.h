#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/study/derived_object.h"
#include "viewer/slice/frame.h"
#include "viewer/slice/presentation.h"
#include "viewer/slice/shutter.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A grayscale softcopy presentation state (PS3.3 A.33.1): the display parameters of its images. Missing
/// parts are not taken from the images: without a rescale, stored values are values; without a window, all
/// values are shown.
struct Presentation {
  /// A part for some of the images; an empty `of` means all of them.
  struct Greys {
    std::vector<ReferencedPicture> of;
    std::vector<NamedGrey> greys;  ///< windows and VOI LUTs; the first applies
  };
  struct Area {
    std::vector<ReferencedPicture> of;
    PixelBox area;
  };
  struct Annotations {
    std::vector<ReferencedPicture> of;
    std::vector<Graphic> graphics;
    std::vector<GraphicText> texts;
  };

  std::string label, description, creator;  ///< UTF-8
  std::string date;                         ///< date in DICOM format
  std::vector<ReferencedPicture> pictures;
  ValueMapping values;
  std::vector<Greys> greys;
  bool inverted = false;  ///< Presentation LUT Shape INVERSE; it overrides MONOCHROME1 of the image
  Shutter shutter;
  PictureTurn turn;
  std::vector<Area> areas;
  std::vector<GraphicLayer> layers;  ///< lowest first
  std::vector<Annotations> annotations;
  std::vector<std::string> warnings;  ///< parts left out and why: sentences without its name
};

/// Reads a presentation state. The Error names the file and the reason.
Result<Presentation> loadPresentation(const std::string& path);

/// True if `pictures` reference frame `frame` (from 0) of an image.
bool namesFrame(const std::vector<ReferencedPicture>& pictures, const std::string& sopInstanceUid, int frame);

/// Returns the grey scales for one frame; null if the presentation state has none for it.
const std::vector<NamedGrey>* greysFor(const Presentation& presentation, const std::string& sopInstanceUid,
                                       int frame);

/// Returns the display parameters for one frame of an image of this size, without grey scales and shutter.
FramePresentation presentationOf(const Presentation& presentation, const std::string& sopInstanceUid,
                                 int frame, glm::ivec2 size);

}  // namespace volumen
