#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// An unpacked archive.
struct UnpackedArchive {
  std::string folder;  ///< private folder, deleted when the program ends
  std::vector<std::pair<std::string, std::string>> leftOut;  ///< name in the archive, reason
};

/// True if `path` begins like a zip archive.
bool isZipArchive(const std::string& path);

/// Unpacks a zip archive below `cacheFolder`; repeated calls unpack once. Names are untrusted: entries that
/// are not files below the archive's root (links, "..") are left out. The Error: the archive is damaged,
/// encrypted, or a bomb. A bomb exceeds 16 GiB, half of the free disk, 200 times its size (above 16 MiB),
/// or 100,000 files.
Result<UnpackedArchive> unpackZip(const std::string& path, const std::string& cacheFolder,
                                  const CancelToken& cancel);

/// Returns a path that can be opened another day: a file unpacked by this program becomes a path into its
/// archive, "/home/ann/study.zip/CT/1.dcm". Other paths are returned unchanged.
std::string lastingPath(const std::string& path);

/// The location of a path on disk.
struct PathOnDisk {
  std::string path;
  bool unpacked = false;                                     ///< an archive or a path into one
  std::vector<std::pair<std::string, std::string>> leftOut;  ///< entries left out (UnpackedArchive)
};

/// Unpacks an archive, or the archive of a path into one (lastingPath()), and returns the location on disk.
/// Other paths are returned unchanged. The Error is that of unpackZip(), or the archive holds no such file.
Result<PathOnDisk> pathOnDisk(const std::string& path, const std::string& cacheFolder,
                              const CancelToken& cancel);

}  // namespace volumen
