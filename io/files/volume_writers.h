#pragma once

#include <string>
#include <vector>

#include "io/files/write_volume.h"

namespace volumen {

/// A format that volumes are written in: the ending that asks for it, and what writes it (writeVolume()).
struct VolumeWriter {
  const char* ending;  ///< in lower case, with its dot
  Status (*write)(const Volume& volume, const std::string& path, const Progress& progress,
                  const CancelToken& cancel);
};

/// All of them.
const std::vector<VolumeWriter>& volumeWriters();
/// ".nrrd, .nii.gz or .mha".
std::string volumeEndings();

Status writePlainNrrd(const Volume& volume, const std::string& path, const Progress& progress,
                      const CancelToken& cancel);
Status writeNifti(const Volume& volume, const std::string& path, const Progress& progress,
                  const CancelToken& cancel);
Status writeMetaImage(const Volume& volume, const std::string& path, const Progress& progress,
                      const CancelToken& cancel);

}  // namespace volumen
