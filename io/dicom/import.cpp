#include "io/dicom/import.h"

#include <iterator>
#include <set>

#include "io/dicom/directory.h"
#include "io/dicom/series.h"
#include "io/dicom/suv.h"
#include "io/dicom/unread.h"
#include "io/study/study.h"
#include "io/zip_archive.h"

namespace volumen::dicom {

namespace {

Image imageOf(const FileHeader& file) {
  Image image;
  static_cast<SeriesIdentity&>(image) = file;
  image.id = instanceId(file);
  image.path = file.path;
  image.notVolume = file.notVolume + ".";
  image.sopInstanceUid = file.sopInstanceUid;
  image.frames = file.format.frames;
  image.rows = file.format.rows;
  image.columns = file.format.columns;
  image.photometric = file.format.photometric;
  image.order = {file.slices.empty() ? 0 : file.slices.front().instance, file.time};
  image.cine = file.cine;
  return image;
}

/// Keeps the files of classes that have pixels here, which were cut off before their pixels.
void keepPictures(std::vector<LostFile>& files, const std::vector<FileHeader>& pictures) {
  std::set<std::string> classes{{}};
  for (const FileHeader& picture : pictures) classes.insert(picture.sopClassUid);
  std::erase_if(files, [&](const LostFile& file) { return !classes.contains(file.identity.sopClassUid); });
}

/// Adds the pictures that a DICOMDIR lists but that are missing.
void addNotFound(const std::string& directory, const std::vector<ListedFile>& listed,
                 const std::vector<std::string>& found, std::vector<LostFile>& lost) {
  const std::string folder = directory.substr(0, directory.find_last_of('/') + 1);
  for (const ListedFile& file : notFound(directory, listed, found)) {
    if (!file.isPicture || file.seriesUid.empty()) continue;
    LostFile missing;
    missing.file.path = folder + file.id;
    missing.file.reason = fileName(directory) + " lists it, and it is not there.";
    missing.identity.studyUid = file.studyUid;
    missing.identity.seriesUid = file.seriesUid;
    lost.push_back(std::move(missing));
  }
}

}  // namespace

void findSeries(const std::vector<std::string>& files, std::vector<Inspection>& inspections,
                std::vector<LostFile> lost, bool all, Study& study) {
  std::vector<FileHeader> pictures;
  std::vector<LostFile> withoutPixels;
  for (std::size_t n = 0; n < files.size(); ++n) {
    Inspection& i = inspections[n];
    switch (i.kind) {
      case Inspection::Kind::notDicom:
        study.other.push_back(
            {files[n], isZipArchive(files[n]) ? "zip archive: open it by itself" : "not an image"});
        lost.push_back({{{files[n], "it is no image, but is named as the slices are."}, true, {}}, {}, true});
        break;
      case Inspection::Kind::noPicture:
        study.other.push_back({files[n], i.listed ? directoryText(files[n], *i.listed, files) : i.text});
        if (i.listed && all) addNotFound(files[n], *i.listed, files, lost);
        if (!i.derivedObject && !i.listed)
          withoutPixels.push_back(
              {{{files[n], "it is a " + i.text + "."}, i.header.seriesUid.empty(), i.position}, i.header});
        if (i.derivedObject) study.derived.push_back(std::move(*i.derivedObject));
        break;
      case Inspection::Kind::refused:
        study.refused.push_back({files[n], i.text, i.again});
        lost.push_back({{study.refused.back(), i.header.seriesUid.empty(), i.position}, i.header});
        break;
      case Inspection::Kind::picture:
        if (i.header.notVolume.empty())
          pictures.push_back(std::move(i.header));
        else
          study.images.push_back(imageOf(i.header));
        break;
    }
  }
  keepPictures(withoutPixels, pictures);
  lost.insert(lost.end(), withoutPixels.begin(), withoutPixels.end());
  Sorted sorted = sortIntoSeries(pictures);
  addSuvFactors(pictures, sorted.volumes);
  addUnread(lost, sorted.volumes);
  std::move(sorted.volumes.begin(), sorted.volumes.end(), std::back_inserter(study.volumes));
  for (const FileHeader* file : sorted.frames) {
    study.images.push_back(imageOf(*file));
    study.images.back().notVolume =
        "Several pictures lie at one place, have one image number, and nothing tells which belong together: "
        "they cannot be shown in 3D.";
  }
}

}  // namespace volumen::dicom
