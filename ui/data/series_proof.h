#pragma once

#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

struct Series;

/// What tells whether a series is the one it was.
struct SeriesProof {
  VoxelGeometry geometry;  ///< of the slices as acquired
  std::string valueType;
  int files = 0;  ///< how many it is made of
  std::string
      instances;  ///< SHA-256 of their SOP Instance UIDs, in hexadecimal digits; empty: they have none
  bool operator==(const SeriesProof&) const = default;
};

SeriesProof proofOf(const Series& series);

/// A folder, named from the path of a series; "." is that path.
struct SavedFolder {
  std::string path;
  bool operator==(const SavedFolder&) const = default;
};

/// The folders of a series' files. None where these lie directly in its path, or where there are more than
/// 1000 of them: then all that is below its path is searched.
std::vector<SavedFolder> foldersOf(const Series& series);

/// What is known of a series that was not found again.
struct MissingSeries {
  SeriesProof proof;
  std::vector<SavedFolder> folders;  ///< as foldersOf() gave them
  bool operator==(const MissingSeries&) const = default;
};

/// What is different, for a sentence: "it has 120 slices instead of 118"; empty where nothing is.
std::string changeText(const SeriesProof& before, const SeriesProof& now);

}  // namespace volumen
