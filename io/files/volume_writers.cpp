#include "io/files/volume_writers.h"

namespace volumen {

const std::vector<VolumeWriter>& volumeWriters() {
  static const std::vector<VolumeWriter> table{
      {".nrrd", writePlainNrrd},
      {".nii.gz", writeNifti},
      {".mha", writeMetaImage},
  };
  return table;
}

std::string volumeEndings() {
  const std::vector<VolumeWriter>& all = volumeWriters();
  std::string text = all.front().ending;
  for (std::size_t n = 1; n < all.size(); ++n)
    text += (n + 1 < all.size() ? ", " : " or ") + std::string(all[n].ending);
  return text;
}

}  // namespace volumen
