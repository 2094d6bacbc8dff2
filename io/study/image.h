#pragma once

#include <string>

#include "io/study/cine.h"
#include "io/study/identity.h"

namespace volumen {

/// A DICOM file that is no volume and whose frames are shown as acquired (io/frames.h): colour pictures,
/// clips, frames without a position.
struct Image : SeriesIdentity {
  std::string id;  ///< SOPInstanceUID or file name, followed by "#n" if several are alike
  std::string path;
  std::string notVolume;  ///< why it is no volume: a sentence without the file's name
  std::string sopInstanceUid;
  int frames = 1, rows = 0, columns = 0;
  std::string photometric;  ///< PhotometricInterpretation; Series::valueType if `isOfStack`
  PictureOrder order;       ///< order of its first frame
  /// True if it could be a volume by itself but is shown in a stack with other pictures.
  bool isOfStack = false;
  Cine cine;
};

}  // namespace volumen
