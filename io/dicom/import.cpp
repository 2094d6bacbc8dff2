#include "io/dicom/import.h"

#include <algorithm>
#include <iterator>

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

void SeriesFinder::add(const std::string& file, Inspection found) {
  files_.push_back(file);
  if (found.kind != Inspection::Kind::picture) {
    others_.emplace_back(file, std::move(found));
  } else if (!found.header.notVolume.empty()) {
    images_.push_back(imageOf(found.header));
  } else {
    const std::string& uid = found.header.seriesUid;
    const auto [known, isNew] = seriesOf_.try_emplace(uid, series_.size());
    if (isNew) series_.push_back({uid, {}});
    series_[known->second].second.push_back(pictures_.size());
    classes_.insert(found.header.sopClassUid);
    pictures_.add(found.header);
  }
}

void SeriesFinder::addOthers(std::vector<LostFile>& lost, bool all, Study& study) {
  std::vector<LostFile> withoutPixels;
  for (auto& [file, i] : others_) {
    if (i.kind == Inspection::Kind::notDicom) {
      study.other.push_back({file, isZipArchive(file) ? "zip archive: open it by itself" : "not an image"});
      lost.push_back({{{file, "it is no image, but is named as the slices are."}, true, {}}, {}, true});
    } else if (i.kind == Inspection::Kind::noPicture) {
      study.other.push_back({file, i.listed ? directoryText(file, *i.listed, files_) : i.text});
      if (i.listed && all) addNotFound(file, *i.listed, files_, lost);
      if (!i.derivedObject && !i.listed)
        withoutPixels.push_back(
            {{{file, "it is a " + i.text + "."}, i.header.seriesUid.empty(), i.position}, i.header});
      if (i.derivedObject) study.derived.push_back(std::move(*i.derivedObject));
    } else {
      study.refused.push_back({file, i.text, i.again});
      lost.push_back({{study.refused.back(), i.header.seriesUid.empty(), i.position}, i.header});
    }
  }
  // Objects of a class without pixels are complete. They were not cut off before their pixels.
  std::erase_if(withoutPixels, [&](const LostFile& file) {
    return !file.identity.sopClassUid.empty() && !classes_.contains(file.identity.sopClassUid);
  });
  lost.insert(lost.end(), withoutPixels.begin(), withoutPixels.end());
}

// Files without a SeriesInstanceUID are series of their own, in the order of the files.
void SeriesFinder::addPictures(Study& study) const {
  std::map<std::size_t, std::vector<Series>> volumes;  // keys: first picture of each series
  std::map<std::size_t, std::vector<Image>> images;
  for (const auto& [uid, numbers] : series_) {
    std::vector<FileHeader> files;
    files.reserve(numbers.size());
    std::map<std::string, std::size_t> alone;
    for (const std::size_t n : numbers) {
      files.push_back(pictures_.at(n));
      if (uid.empty()) alone.emplace(files.back().path, n);
    }
    const auto placeOf = [&alone, first = numbers[0]](const std::string& path) {
      return alone.empty() ? first : alone.at(path);
    };
    Sorted sorted = sortIntoSeries(files);
    addSuvFactors(files, sorted.volumes);
    for (Series& volume : sorted.volumes) volumes[placeOf(volume.files[0])].push_back(std::move(volume));
    for (const FileHeader* file : sorted.frames) {
      Image& image = images[placeOf(file->path)].emplace_back(imageOf(*file));
      image.notVolume =
          "Several pictures lie at one place, have one image number, and nothing tells which belong "
          "together: "
          "they cannot be shown in 3D.";
    }
  }
  for (auto& [place, some] : volumes) std::ranges::move(some, std::back_inserter(study.volumes));
  for (auto& [place, some] : images) std::ranges::move(some, std::back_inserter(study.images));
}

void SeriesFinder::finish(std::vector<LostFile> lost, bool all, Study& study) {
  addOthers(lost, all, study);
  std::ranges::move(images_, std::back_inserter(study.images));
  Study found;
  addPictures(found);
  addUnread(lost, found.volumes);
  std::ranges::move(found.volumes, std::back_inserter(study.volumes));
  std::ranges::move(found.images, std::back_inserter(study.images));
}

}  // namespace volumen::dicom
