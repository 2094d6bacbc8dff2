#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What was unpacked of an archive.
struct UnpackedArchive {
  std::string folder;  ///< of this program alone; it goes when the program ends
  std::vector<std::pair<std::string, std::string>> leftOut;  ///< name in the archive, reason
};

/// Whether `path` begins as a zip archive does.
bool isZipArchive(const std::string& path);

/// Unpacks a zip archive below `cacheFolder`; once, however often it is asked for. Names are untrusted: what
/// is no file below the archive's root (links, "..") is left out. An Error where the archive is damaged or
/// encrypted, or is a bomb: more than 16 GiB or half of the free disk, more than 200 times its size (above 16
/// MiB), or more than 100,000 files.
Result<UnpackedArchive> unpackZip(const std::string& path, const std::string& cacheFolder,
                                  const CancelToken& cancel);

/// How a path is told so that it can be opened another day: what this program has unpacked lies for others in
/// its archive, "/home/ann/study.zip/CT/1.dcm". Any other path as it is.
std::string lastingPath(const std::string& path);

/// Where a path lies on disk.
struct PathOnDisk {
  std::string path;
  bool unpacked = false;                                     ///< it is an archive, or leads into one
  std::vector<std::pair<std::string, std::string>> leftOut;  ///< of a whole archive, as of UnpackedArchive
};

/// Of an archive, and of a path that leads into one (lastingPath), where it is unpacked, which is done here;
/// of any other path itself. An Error as of unpackZip(), or where the archive holds no such file.
Result<PathOnDisk> pathOnDisk(const std::string& path, const std::string& cacheFolder,
                              const CancelToken& cancel);

}  // namespace volumen
