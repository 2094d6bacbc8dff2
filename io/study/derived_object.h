#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/study/identity.h"

namespace volumen {

/// A picture, or some of its frames, that a derived object refers to.
struct ReferencedPicture {
  std::string sopInstanceUid;
  std::string seriesUid;      ///< empty if the object does not give it
  std::vector<int> frames;    ///< frame numbers from 0, ascending; empty means all frames
  std::vector<int> segments;  ///< segment numbers of a segmentation; empty means all segments
  bool operator==(const ReferencedPicture&) const = default;
};

/// The kinds of object that refer to pictures.
enum class DerivedKind {
  presentation,  ///< softcopy presentation state: how pictures are displayed (io/presentation.h)
  keyObjects,    ///< Key Object Selection: key images (io/report.h)
  report,        ///< structured report, TID 1500 among them (io/report.h)
  contours,      ///< RTSTRUCT: regions of interest (io/contours.h)
  segmentation   ///< SEG (io/segmentation.h)
};

/// Returns the kind's name for people and scripts: "presentation state".
const char* kindName(DerivedKind kind);

/// A DICOM object that refers to pictures and is read by itself.
struct DerivedObject : SeriesIdentity {
  DerivedKind kind = DerivedKind::report;
  std::string id;  ///< SOPInstanceUID or file name, followed by "#n" if several are alike
  std::string path, sopInstanceUid;
  std::string label;  ///< label of a presentation state, structure set or segmentation; title of a document
  std::string text;   ///< description of the object; for key objects, the remark on the pictures
  std::string date;   ///< content date as DICOM writes it; empty if not given
  std::vector<ReferencedPicture> pictures;  ///< the pictures and other objects it refers to, each once
  std::vector<std::string> warnings;        ///< sentences about guesses, such as of a character set
  std::size_t notHere = 0;                  ///< number of `pictures` that the study does not hold
};

}  // namespace volumen
