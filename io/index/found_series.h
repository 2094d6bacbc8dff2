#pragma once

#include <string>
#include <vector>

#include "io/study/identity.h"

namespace volumen {

struct Series;
struct Study;

/// A file as a part of its series.
struct FoundFile {
  std::string path, sopInstanceUid;
  int volume = 0;  ///< number of its first volume in the series, from 1; 0 if it is in none
  int frames = 0;  ///< number of slices and frames
};

/// A series in the index: combines a Study's volumes, images and derived objects.
struct FoundSeries {
  SeriesIdentity identity;
  bool isDicom = true;
  std::string time, label;
  bool isVolume = false;
  std::vector<std::string> warnings;
  std::vector<FoundFile> files;  ///< unique; files of volumes come first, in slice order
};

/// Returns the series of a study. Each file without a SeriesInstanceUID is a series.
std::vector<FoundSeries> seriesOf(const Study& study);

/// Adds copies of images to their series, which a study left out and a search of their own found. They show
/// nothing, but one remains if the other is removed.
void addCopies(const Study& copies, std::vector<FoundSeries>& series);

/// Adds a warning if files of one SOP Instance UID differ in their bytes.
void warnOfOtherBytes(FoundSeries& series);

/// Returns how the volumes of a series differ: "4 echoes", "451 directions", "12 volumes"; empty for one.
std::string whatVaries(const std::vector<const Series*>& volumes);

}  // namespace volumen
