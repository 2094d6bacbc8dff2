#include "io/open.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "io/dicom/directory.h"
#include "io/dicom/import.h"
#include "io/files/image_pair.h"
#include "io/files/sample_cache.h"
#include "io/files/session_file.h"
#include "io/look.h"
#include "io/phantom.h"
#include "io/study/arrange.h"
#include "io/walk.h"
#include "io/zip_archive.h"

namespace volumen {
namespace {

// Returns the reason in a message about a file: "compressed." from "F is compressed."
std::string reasonWithout(const std::string& file, std::string sentence) {
  for (const std::string& begin : {file + ": ", file + " is ", file + " "})
    if (sentence.starts_with(begin)) return sentence.substr(begin.size());
  return sentence;
}

// Returns the folder of a path; "." if it names none.
std::string folderOf(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

// Returns the files of a path: the file itself, or all below a folder. A DICOMDIR stands for its folder, a
// zip archive or a path into one for its contents. For samples of a pair, the header is added.
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

/// The number of headers held at once before they are sorted, at about 10 KB each.
constexpr std::size_t filesAtOnce = 4096;

/// Adds the headers of all files to a study, unsorted. `all` means that these are all files of a path.
void addFiles(const FoundFiles& found, bool all, const Progress& progress, const CancelToken& cancel,
              Study& study) {
  const std::vector<std::string>& files = found.files;
  std::vector<dicom::LostFile> lost;
  for (const UnreadableEntry& entry : found.unreadable) {
    study.refused.push_back({entry.path, entry.reason + "."});
    if (!entry.elsewhere) lost.push_back({{study.refused.back(), true, {}}, {}});
  }
  dicom::SeriesFinder series;
  const auto take = [&](const std::string& file, LookedAt looked) {
    if (!looked.isImageFile) {
      series.add(file, std::move(looked.dicom));
    } else if (!looked.problem.empty()) {
      study.refused.push_back({file, reasonWithout(file, looked.problem)});
      lost.push_back({{study.refused.back(), true, {}}, {}, !looked.gzippedDicom});
    } else {
      std::move(looked.volumes.begin(), looked.volumes.end(), std::back_inserter(study.volumes));
    }
  };
  for (std::size_t done = 0; done < files.size() && !cancel.cancelled(); done += filesAtOnce) {
    const std::size_t end = std::min(files.size(), done + filesAtOnce);
    const std::vector<std::string> some(files.begin() + std::ptrdiff_t(done),
                                        files.begin() + std::ptrdiff_t(end));
    const auto behind = [&](const char* doing, std::size_t n, std::size_t) {
      progress(doing, done + n, files.size());
    };
    std::vector<LookedAt> looked = lookAtFiles(some, progress ? Progress(behind) : Progress(), cancel);
    for (std::size_t n = 0; n < some.size(); ++n) take(some[n], std::move(looked[n]));
  }
  if (!cancel.cancelled()) series.finish(std::move(lost), all, study);
}

Result<Study> open(const FoundFiles& found, bool all, const Progress& progress, const CancelToken& cancel) {
  Study study;
  addFiles(found, all, progress, cancel, study);
  if (cancel.cancelled()) return Error{"Interrupted."};
  arrange(study);
  return study;
}

}  // namespace

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

}  // namespace volumen
