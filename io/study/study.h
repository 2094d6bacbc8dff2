#pragma once

#include <string>
#include <vector>

#include "io/study/image.h"
#include "io/study/reference.h"
#include "io/study/series.h"

namespace volumen {

/// Valid, but no volume: SR, RT, DICOMDIR, a text file. What refers to pictures is in Study::references, too.
struct Other {
  std::string path, kind;
};

/// All that one PATH holds. Volumes in `info`'s order: patient, study, series number, position; images and
/// references by patient, study, series number and path. Of the other lists what is in one is in none else.
struct Study {
  std::vector<Series> volumes;
  std::vector<Image> images;
  std::vector<Refused> refused;
  std::vector<Other> other;
  std::vector<Reference> references;  ///< their files are in `other`, too
};

}  // namespace volumen
