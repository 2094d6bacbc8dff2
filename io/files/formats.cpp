#include "io/files/formats.h"

#include "io/files/meta_image.h"
#include "io/files/nifti.h"
#include "io/files/nrrd.h"

namespace volumen {

namespace {

bool beginsAsNrrd(const FileClaim& file) { return !file.isCompressed && isNrrdHead(file.head); }
bool beginsAsMetaImage(const FileClaim& file) {
  return !file.isCompressed &&
         (file.head.starts_with("ObjectType = Image") || file.head.starts_with("NDims = "));
}
bool isNifti(const FileClaim& file) {
  return isNiftiHead(file.head) || file.name.ends_with(".nii") || file.name.ends_with(".nii.gz");
}
bool isNamedNrrd(const FileClaim& file) {
  return file.name.ends_with(".nrrd") || file.name.ends_with(".nhdr");
}
bool isNamedMetaImage(const FileClaim& file) {
  return file.name.ends_with(".mha") || file.name.ends_with(".mhd");
}

}  // namespace

const std::vector<FileFormat>& fileFormats() {
  static const std::vector<FileFormat> table{
      {"NRRD", beginsAsNrrd, readNrrdHeader},
      {"MetaImage", beginsAsMetaImage, readMetaImageHeader},
      {"Analyze", isAnalyze, readAnalyzeHeader},
      {"VTK", isVtk, readVtkHeader},
      {"MGH", isMgh, readMghHeader},
      {"GIPL", isGipl, readGiplHeader},
      {"MRC", isMrc, readMrcHeader},
      {"NIfTI", isNifti, readNiftiHeader},
      {"NRRD by name", isNamedNrrd, readNrrdHeader},
      {"MetaImage by name", isNamedMetaImage, readMetaImageHeader},
  };
  return table;
}

}  // namespace volumen
