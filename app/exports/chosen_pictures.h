#pragma once

#include <string>
#include <vector>

#include "io/study/study.h"
#include "results/pictures/picture_greys.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Pictures that a command line names.
struct ChosenPictures : SeriesPictures {
  bool hasPlace = false;           ///< true for a volume, which shapes in the patient can lie in
  std::vector<std::string> notes;  ///< sentences on what was chosen for the user
};

/// Returns the pictures `images` of the series that --series names (a volume as chooseSeries() does, or
/// pictures by the id or UID of their series, or by that of an image); all of the series without images.
/// Those of files that are copies of others are left out.
/// Without --series it is the one that holds the first of `images`, else `instance`, else the largest volume,
/// else the first pictures. The Error: there is no such series or image, or it comes from no DICOM files.
Result<ChosenPictures> choosePictures(const std::string& path, const Study& study, const std::string& series,
                                      const std::vector<ReferencedPicture>& images,
                                      const std::string& instance);

}  // namespace volumen
