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
  int volume = 0;  ///< the first volume of the series that it is part of, from 1; 0: of none
  int frames = 0;  ///< slices and frames in it
};

/// A series as the index keeps it: what a Study says of its volumes, images and derived objects together.
struct FoundSeries {
  SeriesIdentity identity;
  bool isDicom = true;
  std::string time, label;
  bool isVolume = false;
  std::vector<std::string> warnings;
  std::vector<FoundFile> files;  ///< each once; those of volumes first, in the order of slices
};

/// The series of a study. Files without a SeriesInstanceUID are a series each.
std::vector<FoundSeries> seriesOf(const Study& study);

/// Adds copies of pictures that a study left out, and that were found by opening them alone, to their series:
/// as files that show nothing, so that one remains where the other goes.
void addCopies(const Study& copies, std::vector<FoundSeries>& series);

/// Adds a warning where files of one SOP Instance UID hold different bytes.
void warnOfOtherBytes(FoundSeries& series);

/// What tells the volumes of one series apart: "4 echoes", "451 directions", "12 volumes"; empty for one.
std::string whatVaries(const std::vector<const Series*>& volumes);

}  // namespace volumen
