#include "io/study.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <map>
#include <tuple>
#include <unordered_set>

#include "io/archive.h"
#include "io/dicom/directory.h"
#include "io/dicom/import.h"
#include "io/files/image_file.h"
#include "io/files/image_pair.h"
#include "io/files/sample_cache.h"
#include "io/files/session_file.h"
#include "io/look.h"
#include "io/walk.h"
#include "viewer/phantoms/phantoms.h"

namespace volumen {
namespace {

constexpr std::string_view phantomPrefix = "phantom:", sampleStudy = "ct-head";

bool isPhantom(const std::string& path) { return path.starts_with(phantomPrefix); }

std::string phantomName(const std::string& path) { return path.substr(phantomPrefix.size()); }

Result<Study> openPhantom(const std::string& path) {
  const Result<PhantomHeader> phantom = phantomHeader(phantomName(path));
  if (!phantom) return phantom.error();
  Series series;
  series.id = series.path = path;
  series.format = "phantom";
  series.description = phantomName(path);
  series.modality = phantom->modality;
  if (series.modality == "CT") series.unit = "HU";
  series.acquired = phantom->geometry;
  series.valueType = phantom->valueType;
  Study study;
  study.volumes.push_back(series);
  return study;
}

long numberOf(const std::string& text) {
  long n = 0;
  std::from_chars(text.data(), text.data() + text.size(), n);
  return n;
}

/// Tells volumes of one series (or files of one name) apart by "#1", "#2", ... behind their ids.
template <class Found>
void numberParts(std::vector<Found>& all) {
  std::map<std::string, int> count, next;
  for (const Found& found : all) ++count[found.id];
  for (Found& found : all)
    if (const std::string id = found.id; count[id] > 1)
      found.id.append("#").append(std::to_string(++next[id]));
}

/// `info`'s order: patient, study, series number, ...
auto orderKey(const SeriesIdentity& s) {
  return std::make_tuple(std::tie(s.patientName, s.patientId, s.studyDate, s.studyUid),
                         numberOf(s.seriesNumber));
}

/// ... and within a series as its reader has them: by position, then by what tells them apart.
void sortVolumes(std::vector<Series>& volumes) {
  const auto key = [](const Series& s) {
    return std::make_tuple(orderKey(s), s.seriesUid.empty() ? s.path : s.seriesUid);
  };
  std::stable_sort(volumes.begin(), volumes.end(),
                   [&](const Series& a, const Series& b) { return key(a) < key(b); });
}

/// ... path.
template <class Found>
void sortFiles(std::vector<Found>& files) {
  const auto key = [](const Found& f) { return std::make_tuple(orderKey(f), std::tie(f.seriesUid, f.path)); };
  std::stable_sort(files.begin(), files.end(),
                   [&](const Found& a, const Found& b) { return key(a) < key(b); });
}

/// Counts what the objects refer to and the study does not hold.
void countNotHere(Study& study) {
  std::unordered_set<std::string_view> here;
  if (study.references.empty()) return;
  for (const Series& s : study.volumes) here.insert(s.sopInstanceUids.begin(), s.sopInstanceUids.end());
  for (const Image& image : study.images) here.insert(image.sopInstanceUid);
  for (const Reference& object : study.references) here.insert(object.sopInstanceUid);
  for (Reference& object : study.references)
    object.notHere = std::size_t(std::ranges::count_if(
        object.pictures, [&](const ReferencedPicture& p) { return !here.contains(p.sopInstanceUid); }));
}

/// A sentence about a file, "F is compressed.", as a reason that stands behind its name: "compressed."
std::string reasonWithout(const std::string& file, std::string sentence) {
  for (const std::string& begin : {file + ": ", file + " is ", file + " "})
    if (sentence.starts_with(begin)) return sentence.substr(begin.size());
  return sentence;
}

/// The folder that a path ends in: "." where it names none.
std::string folderOf(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

/// The files that a path stands for: itself or what is below it; all below its folder where it is a DICOMDIR;
/// what is in it where it is a zip archive, or the part of one that it leads into; the header, too, of
/// samples that are one half of a pair.
Result<FoundFiles> filesOf(const std::string& path, const CancelToken& cancel) {
  const Result<PathOnDisk> place = pathOnDisk(path, userCacheFolder(), cancel);
  if (!place) return place.error();
  const bool listed = dicom::isDirectoryFile(place->path);
  Result<FoundFiles> found = findFiles(listed ? folderOf(place->path) : place->path, cancel,
                                       listed || place->unpacked ? Links::inside : Links::files);
  if (!found) return found;
  if (found->files == std::vector{place->path})
    if (const auto header = headerOfPair(place->path)) found->files.push_back(*header);
  for (const auto& [name, reason] : place->leftOut) found->unreadable.push_back({path + "/" + name, reason});
  return found;
}

/// What the headers of all files say, not in order. `all`: of all that a path holds.
void addFiles(const FoundFiles& found, bool all, const Progress& progress, const CancelToken& cancel,
              Study& study) {
  const std::vector<std::string>& files = found.files;
  std::vector<dicom::LostFile> lost;
  for (const UnreadableEntry& entry : found.unreadable) {
    study.refused.push_back({entry.path, entry.reason + "."});
    if (!entry.elsewhere) lost.push_back({{study.refused.back(), true, {}}, {}, {}});
  }
  std::vector<LookedAt> looked = lookAtFiles(files, progress, cancel);
  std::vector<std::string> others;
  std::vector<dicom::Inspection> inspections;
  for (std::size_t n = 0; n < files.size(); ++n) {
    if (!looked[n].isImageFile) {
      others.push_back(files[n]);
      inspections.push_back(std::move(looked[n].dicom));
    } else if (!looked[n].problem.empty()) {
      study.refused.push_back({files[n], reasonWithout(files[n], looked[n].problem)});
      lost.push_back({{study.refused.back(), true, {}}, {}, {}, !looked[n].gzippedDicom});
    } else {
      std::move(looked[n].volumes.begin(), looked[n].volumes.end(), std::back_inserter(study.volumes));
    }
  }
  if (!cancel.cancelled()) dicom::findSeries(others, inspections, std::move(lost), all, study);
}

Result<Study> open(const FoundFiles& found, bool all, const Progress& progress, const CancelToken& cancel) {
  Study study;
  addFiles(found, all, progress, cancel, study);
  if (cancel.cancelled()) return Error{"Interrupted."};
  sortVolumes(study.volumes);
  numberParts(study.volumes);
  sortFiles(study.images);
  numberParts(study.images);
  sortFiles(study.references);
  numberParts(study.references);
  countNotHere(study);
  return study;
}

}  // namespace

const char* kindName(ReferenceKind kind) {
  constexpr const char* names[] = {"presentation state", "key objects", "report", "contours", "segmentation"};
  return names[int(kind)];
}

Result<Study> openStudy(const std::string& path, const Progress& progress, const CancelToken& cancel) {
  if (isPhantom(path)) return openPhantom(path);
  if (isSessionFile(path))
    return Error{path + " is a session, not a volume: `volumen open` and `volumen render` take it."};
  const Result<FoundFiles> found = filesOf(path, cancel);
  if (!found) return found.error();
  Result<Study> study = open(*found, true, progress, cancel);
  return study ? std::move(study) : Error{path + ": interrupted."};
}

Result<Study> openFolders(const std::string& path, const std::vector<std::string>& folders,
                          const Progress& progress, const CancelToken& cancel) {
  const Result<PathOnDisk> place = pathOnDisk(path, userCacheFolder(), cancel);
  if (!place) return place.error();
  std::vector<std::string> there;
  for (const std::string& folder : folders)
    there.push_back((std::filesystem::path(place->path) / folder).lexically_normal().string());
  return openFiles(filesDirectlyIn(there), progress, cancel);
}

Result<Study> openFiles(const std::vector<std::string>& files, const Progress& progress,
                        const CancelToken& cancel) {
  return open({files, {}}, false, progress, cancel);
}

Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel) {
  if (series.format == "DICOM") return dicom::loadSeries(series, progress, cancel);
  if (series.format == "phantom") {
    const std::string name = phantomName(series.path);
    if (progress) progress("making the phantom", 0, 0);
    Result<VolumePtr> volume =
        name == sampleStudy ? cachedPhantom(name, userCacheFolder()) : makePhantom(name);
    if (!volume) return volume.error();
    return Loaded{*volume, *volume, {}};
  }
  return loadImageFile(series, progress, cancel);
}

int Loaded::interpolatedSlices() const {
  return int(std::ranges::count_if(origins, &SliceOrigin::isInterpolated));
}

Result<std::size_t> chooseSeries(const Study& study, const std::string& text) {
  const std::vector<Series>& all = study.volumes;
  if (all.empty()) return Error{"There is no series to choose from."};
  if (text.empty()) {
    const auto most = std::max_element(all.begin(), all.end(), [](const Series& a, const Series& b) {
      return a.acquired.voxelCount() < b.acquired.voxelCount();
    });
    return std::size_t(most - all.begin());
  }
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].id == text) return n;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].seriesUid == text) return n;
  const bool isNumber = text.find_first_not_of("0123456789") == std::string::npos && text.size() <= 9;
  if (isNumber && numberOf(text) >= 1 && std::size_t(numberOf(text)) <= all.size())
    return std::size_t(numberOf(text)) - 1;
  return Error{"Unknown series \"" + text + "\"."};
}

}  // namespace volumen
