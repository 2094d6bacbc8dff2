#pragma once

#include <string>
#include <vector>

#include "io/study/derived_object.h"
#include "io/study/image.h"
#include "io/study/series.h"

namespace volumen {

/// Valid, but no volume: SR, RT, DICOMDIR, a text file. What refers to pictures is in Study::derived, too.
struct Other {
  std::string path, kind;
};

/// All that one PATH holds. Volumes in `info`'s order: patient, study, series number, position; images and
/// derived objects by patient, study, series number and path. Of the other lists what is in one is in none
/// else.
struct Study {
  std::vector<Series> volumes;
  std::vector<Image> images;
  std::vector<Refused> refused;
  std::vector<Other> other;
  std::vector<DerivedObject> derived;  ///< their files are in `other`, too
};

}  // namespace volumen
