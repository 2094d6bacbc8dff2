#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/study/identity.h"

namespace volumen {

/// A picture, or some of its frames, that an object refers to.
struct ReferencedPicture {
  std::string sopInstanceUid;
  std::string seriesUid;      ///< empty where it is not said
  std::vector<int> frames;    ///< from 0, in order; none: all of them
  std::vector<int> segments;  ///< of a segmentation, their numbers; none: all of them
};

/// What kind of object refers to pictures.
enum class DerivedKind {
  presentation,  ///< softcopy presentation states: how pictures are to be shown (io/presentation.h)
  keyObjects,    ///< Key Object Selection: pictures that are marked (io/report.h)
  report,        ///< structured reports, among them TID 1500 (io/report.h)
  contours,      ///< RTSTRUCT: regions of interest (io/contours.h)
  segmentation   ///< SEG (io/segmentation.h)
};

/// The kind's name for people and scripts: "presentation state".
const char* kindName(DerivedKind kind);

/// A DICOM object that refers to pictures and can be read by itself.
struct DerivedObject : SeriesIdentity {
  DerivedKind kind = DerivedKind::report;
  std::string id;  ///< SOPInstanceUID or file name, "#n" behind it where several are alike
  std::string path, sopInstanceUid;
  std::string label;  ///< of presentation states, structure sets and segmentations; the title of documents
  std::string text;   ///< the description that goes with it; of key objects what is said of the pictures
  std::string date;   ///< as DICOM writes it: of the content; empty where it is not given
  std::vector<ReferencedPicture> pictures;  ///< pictures and other objects, each once
  std::size_t notHere = 0;                  ///< how many of `pictures` the study does not hold
};

}  // namespace volumen
