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

/// From stored values to values: a rescale, or a table that stands in for it (PS3.3 C.11.1).
struct ValueMapping {
  double slope = 1, intercept = 0;
  double first = 0;                  ///< the stored value of the table's first entry
  std::vector<std::uint16_t> table;  ///< empty: the rescale counts
  std::string unit;                  ///< "HU"; empty: none that is known

  float operator()(double stored) const;
};

/// A grayscale softcopy presentation state (PS3.3 A.33.1): how the pictures that it refers to are to be
/// shown. What it leaves out is not taken from the pictures: without a rescale stored values are values,
/// without a window all of them are shown.
struct Presentation {
  /// A part that holds for some of the pictures; `of` empty: for all of them.
  struct Greys {
    std::vector<ReferencedPicture> of;
    std::vector<NamedGrey> greys;  ///< windows and VOI LUTs; the first counts
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
  std::string date;                         ///< as DICOM writes it
  std::vector<ReferencedPicture> pictures;
  ValueMapping values;
  std::vector<Greys> greys;
  bool inverted =
      false;  ///< Presentation LUT Shape INVERSE; MONOCHROME1 of a picture does not count beside it
  Shutter shutter;
  PictureTurn turn;
  std::vector<Area> areas;
  std::vector<GraphicLayer> layers;  ///< the lowest first
  std::vector<Annotations> annotations;
  std::vector<std::string> warnings;  ///< what of it is left out and why: sentences without its name
};

/// Reads a presentation state. An Error names the file and why.
Result<Presentation> loadPresentation(const std::string& path);

/// Whether `pictures` name frame `frame` (from 0) of a picture.
bool namesFrame(const std::vector<ReferencedPicture>& pictures, const std::string& sopInstanceUid, int frame);

/// Its ways from value to grey for one frame; none where it says nothing of them.
const std::vector<NamedGrey>* greysFor(const Presentation& presentation, const std::string& sopInstanceUid,
                                       int frame);

/// What a presentation state says of one frame of a picture of this size its greys and
/// shutter.
FramePresentation presentationOf(const Presentation& presentation, const std::string& sopInstanceUid,
                                 int frame, glm::ivec2 size);

}  // namespace volumen
