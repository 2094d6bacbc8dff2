#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/file_state.h"
#include "io/index/found_series.h"
#include "io/study/progress.h"
#include "io/study/unread.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A file on disk: its folder without symbolic links in its path, its name there.
struct FileOnDisk {
  std::string folder, name;
  FileState state;
  std::string path() const { return folder == "/" ? folder + name : folder + "/" + name; }
};

/// What a study says beside SeriesIdentity: of the first file of a series, raw text.
struct FurtherIdentity {
  std::string birthDate, sex, accessionNumber, institution, studyTime, seriesDate, seriesTime;
};

/// Of a DICOM file. An Error where it cannot be read.
Result<FurtherIdentity> furtherIdentity(const std::string& path);

/// A series that was read, ready to be written.
struct ReadSeries : FoundSeries {
  FurtherIdentity further;
};

/// What files hold, in the words of the index.
struct ReadFiles {
  std::vector<ReadSeries> series;
  std::vector<Refused> refused;  ///< in no series; also pictures that series had to leave out
  std::vector<Refused>
      lacking;  ///< no images, which series lack all the same: as their slices are named, ...
};

/// Opens files as openFiles does. An Error only where it was cancelled.
Result<ReadFiles> readFiles(const std::vector<std::string>& paths, const Progress& progress,
                            const CancelToken& cancel);

}  // namespace volumen
