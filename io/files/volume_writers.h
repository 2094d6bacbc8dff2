#pragma once

#include <string>
#include <vector>

#include "io/files/write_volume.h"

namespace volumen {

/// A format for writing volumes: its file name ending and its writer (writeVolume()).
struct VolumeWriter {
  const char* ending;  ///< lower case, with the dot
  Status (*write)(const Volume& volume, const std::string& path, const Progress& progress,
                  const CancelToken& cancel);
};

const std::vector<VolumeWriter>& volumeWriters();
/// Returns ".nrrd, .nii.gz or .mha".
std::string volumeEndings();

Status writePlainNrrd(const Volume& volume, const std::string& path, const Progress& progress,
                      const CancelToken& cancel);
Status writeNifti(const Volume& volume, const std::string& path, const Progress& progress,
                  const CancelToken& cancel);
Status writeMetaImage(const Volume& volume, const std::string& path, const Progress& progress,
                      const CancelToken& cancel);

}  // namespace volumen
