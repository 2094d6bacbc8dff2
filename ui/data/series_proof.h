#pragma once

#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

struct Series;

/// The facts that show whether a series is still the same.
struct SeriesProof {
  VoxelGeometry geometry;  ///< of the acquired slices
  std::string valueType;
  int files = 0;  ///< number of its files
  std::string
      instances;  ///< SHA-256 of their SOP Instance UIDs, in hexadecimal digits; empty: they have none
  bool operator==(const SeriesProof&) const = default;
};

SeriesProof proofOf(const Series& series);

/// A folder relative to the path of a series; "." is that path.
struct SavedFolder {
  std::string path;
  bool operator==(const SavedFolder&) const = default;
};

/// Returns the folders of a series' files. Empty if these lie directly in its path, or in more than 1000
/// folders: then everything below its path is searched.
std::vector<SavedFolder> foldersOf(const Series& series);

/// The known facts of a series that was not found.
struct MissingSeries {
  SeriesProof proof;
  std::vector<SavedFolder> folders;  ///< from foldersOf()
  bool operator==(const MissingSeries&) const = default;
};

/// Returns the difference for a sentence: "it has 120 slices instead of 118"; empty if there is none.
std::string changeText(const SeriesProof& before, const SeriesProof& now);

}  // namespace volumen
