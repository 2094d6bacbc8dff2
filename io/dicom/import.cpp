#include "io/dicom/import.h"

#include <iterator>

#include "io/archive.h"
#include "io/dicom/directory.h"
#include "io/dicom/series.h"

namespace volumen::dicom {

namespace {

Image imageOf(const FileHeader& file) {
  Image image;
  static_cast<SeriesIdentity&>(image) = file;
  image.id = instanceId(file);
  image.path = file.path;
  image.notVolume = file.notVolume + ".";
  image.sopInstanceUid = file.sopInstanceUid;
  image.sopClassUid = file.sopClassUid;
  image.frames = file.format.frames;
  image.rows = file.format.rows;
  image.columns = file.format.columns;
  image.photometric = file.format.photometric;
  image.cine = file.cine;
  return image;
}

}  // namespace

void findSeries(const std::vector<std::string>& files, std::vector<Inspection>& inspections, Study& study) {
  std::vector<FileHeader> pictures;
  for (std::size_t n = 0; n < files.size(); ++n) {
    Inspection& i = inspections[n];
    switch (i.kind) {
      case Inspection::Kind::notDicom:
        study.other.push_back(
            {files[n], isZipArchive(files[n]) ? "zip archive: open it by itself" : "not an image"});
        break;
      case Inspection::Kind::noPicture:
        study.other.push_back({files[n], i.listed ? directoryText(files[n], *i.listed, files) : i.text});
        if (i.reference) study.references.push_back(std::move(*i.reference));
        break;
      case Inspection::Kind::refused:
        study.refused.push_back({files[n], i.text});
        break;
      case Inspection::Kind::picture:
        if (i.header.notVolume.empty())
          pictures.push_back(std::move(i.header));
        else
          study.images.push_back(imageOf(i.header));
        break;
    }
  }
  Sorted sorted = sortIntoSeries(pictures);
  addSuvFactors(pictures, sorted.volumes);
  std::move(sorted.volumes.begin(), sorted.volumes.end(), std::back_inserter(study.volumes));
  for (const FileHeader* file : sorted.frames) {
    study.images.push_back(imageOf(*file));
    study.images.back().notVolume =
        "Several pictures lie at one place, have one image number, and nothing tells which belong together: "
        "they cannot be shown in 3D.";
  }
}

}  // namespace volumen::dicom
