#pragma once

#include <string>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// Returns whether `path` is a DICOMDIR (PS3.10 8) by its file meta information, whatever its name.
bool isDirectoryFile(const std::string& path);

/// DirectoryRecordSequence, which only a DICOMDIR has.
inline constexpr std::uint32_t directoryRecords = 0x00041220;

/// A file named by a record of a DICOMDIR.
struct ListedFile {
  std::string id;                   ///< file ID as written, with components joined by '/'
  std::string studyUid, seriesUid;  ///< UIDs of the records above it
  bool isPicture = false;
};

/// Returns the files that the records of a DICOMDIR name.
std::vector<ListedFile> listedFiles(const DataSet& data);

/// Describes a DICOMDIR in a few words. Counts the listed files, those not among `found` below its folder,
/// and those that lead out of it. It opens no file and compares names alone, ignoring case.
std::string directoryText(const std::string& path, const std::vector<ListedFile>& listed,
                          const std::vector<std::string>& found);

/// Returns the listed files that are not among `found` below the folder of the DICOMDIR.
std::vector<ListedFile> notFound(const std::string& path, const std::vector<ListedFile>& listed,
                                 const std::vector<std::string>& found);

}  // namespace volumen::dicom
