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

/// A file on disk: its folder without symbolic links, and its name there.
struct FileOnDisk {
  std::string folder, name;
  FileState state;
  std::string path() const { return folder == "/" ? folder + name : folder + "/" + name; }
};

/// A study's attributes beside SeriesIdentity, as raw text from the first file of a series.
struct FurtherIdentity {
  std::string birthDate, sex, accessionNumber, institution, studyTime, seriesDate, seriesTime;
};

/// Reads them from a DICOM file. The Error: it cannot be read.
Result<FurtherIdentity> furtherIdentity(const std::string& path);

/// A series that was read, ready to be written to the index.
struct ReadSeries : FoundSeries {
  FurtherIdentity further;
};

/// The contents of files for the index.
struct ReadFiles {
  std::vector<ReadSeries> series;
  std::vector<Refused> refused;  ///< files in no series, including images that series had to leave out
  std::vector<Refused> lacking;  ///< no images, but named like slices of a series, ...
};

/// Opens files with openFiles(). The Error: only if cancelled.
Result<ReadFiles> readFiles(const std::vector<std::string>& paths, const Progress& progress,
                            const CancelToken& cancel);

}  // namespace volumen
