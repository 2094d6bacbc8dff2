#pragma once

#include <string>

#include "io/study/cine.h"
#include "io/study/identity.h"

namespace volumen {

/// A DICOM file that is no volume and whose frames can be shown as acquired (io/frames.h): colour, clips,
/// frames without a place.
struct Image : SeriesIdentity {
  std::string id;         ///< SOPInstanceUID or file name, "#n" behind it where several are alike
  std::string path;       ///< of the file
  std::string notVolume;  ///< why it is no volume: a sentence without the file's name
  std::string sopInstanceUid;
  int frames = 1, rows = 0, columns = 0;
  std::string photometric;  ///< PhotometricInterpretation; where isOfStack Series::valueType
  PictureOrder order;       ///< of its first frame
  bool isOfStack = false;   ///< it could be a volume by itself, but is shown in a stack of other pictures
  Cine cine;
};

}  // namespace volumen
