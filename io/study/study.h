#pragma once

#include <string>
#include <vector>

#include "io/study/derived_object.h"
#include "io/study/image.h"
#include "io/study/series.h"

namespace volumen {

/// A valid file that is no volume: SR, RT, DICOMDIR, a text file. Objects that refer to pictures are in
/// Study::derived too.
struct Other {
  std::string path, kind;
};

/// The contents of one PATH. Volumes are in `info`'s order: patient, study, series number, position. Images
/// and derived objects are sorted by patient, study, series number and path. A file in `refused` or `other`
/// is in no other list, except for those of `derived`.
struct Study {
  std::vector<Series> volumes;
  std::vector<Image> images;
  std::vector<Refused> refused;
  std::vector<Other> other;
  std::vector<DerivedObject> derived;  ///< derived objects, whose files are in `other` too
};

}  // namespace volumen
