#pragma once

#include <string>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// Whether `path` is a DICOMDIR (PS3.10 8), whatever its name, by its file meta information.
bool isDirectoryFile(const std::string& path);

/// DirectoryRecordSequence: what makes a data set a DICOMDIR.
inline constexpr std::uint32_t directoryRecords = 0x00041220;

/// A file that a record of a DICOMDIR names.
struct ListedFile {
  std::string id;                   ///< its file ID, the components joined by '/', as they stand there
  std::string studyUid, seriesUid;  ///< of the records above it
  bool isPicture = false;
};

/// The files that a DICOMDIR's records name.
std::vector<ListedFile> listedFiles(const DataSet& data);

/// What a DICOMDIR is, in a few words: how many files it lists, and how many of these are not among `found`
/// below its folder or lead out of it. Nothing is opened: names are only compared, whatever their case.
std::string directoryText(const std::string& path, const std::vector<ListedFile>& listed,
                          const std::vector<std::string>& found);

/// Those of the listed files that are not among `found` below the folder of the DICOMDIR.
std::vector<ListedFile> notFound(const std::string& path, const std::vector<ListedFile>& listed,
                                 const std::vector<std::string>& found);

}  // namespace volumen::dicom
