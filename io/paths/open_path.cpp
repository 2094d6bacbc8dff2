#include "io/paths/open_path.h"

#include <filesystem>

#include "io/archive/fetched_studies.h"
#include "io/index/index.h"
#include "io/open.h"
#include "io/paths/archive_path.h"
#include "io/phantom.h"
#include "io/walk.h"

namespace volumen {
namespace {

constexpr std::string_view prefix = "index:", archivePrefix = "archive:";

Result<IndexedStudy> findStudy(const Index& index, const std::string& wanted) {
  const Result<std::vector<IndexedStudy>> all = index.studies();
  if (!all) return all.error();
  std::vector<IndexedStudy> found;
  for (const IndexedStudy& study : *all)
    if (study.studyUid == wanted) found.push_back(study);
  for (const IndexedStudy& study : *all)
    if (found.empty() && std::to_string(study.id) == wanted) found.push_back(study);
  if (found.size() == 1) return found[0];
  if (found.empty())
    return Error{"The index holds no study \"" + wanted +
                 "\": `volumen list` shows the numbers of its studies."};
  return Error{"The index holds " + std::to_string(found.size()) + " studies of the UID " + wanted +
               ": name one by its number in `volumen list`."};
}

std::string describe(const IndexedSeries& series) {
  return "\n  " + series.number + "  " + series.modality + ' ' + series.description + "  " + series.seriesUid;
}

Result<std::int64_t> findSeries(const Index& index, std::int64_t study, const std::string& wanted) {
  const Result<std::vector<IndexedSeries>> all = index.series(study);
  if (!all) return all.error();
  std::vector<IndexedSeries> found;
  std::string held, alike;
  for (const IndexedSeries& series : *all) {
    held += describe(series);
    if (series.seriesUid != wanted && series.number != wanted) continue;
    found.push_back(series);
    alike += describe(series);
  }
  if (found.size() == 1) return found[0].id;
  if (found.empty()) return Error{"The study holds no series \"" + wanted + "\". It holds:" + held};
  return Error{"Several series have the number " + wanted + "; name one by its UID:" + alike};
}

Result<std::vector<std::string>> filesOf(const std::string& named) {
  const std::string folder = userIndexFolder();
  std::error_code ignored;
  if (folder.empty() || !std::filesystem::exists(folder + "/index.sqlite", ignored))
    return Error{"There is no index yet: `volumen import PATH` makes it."};
  const Result<Index> index = Index::openAsItIs(folder);
  if (!index) return index.error();
  const std::size_t slash = named.find('/');
  const Result<IndexedStudy> study = findStudy(*index, named.substr(0, slash));
  if (!study) return study.error();
  std::int64_t series = 0;
  if (slash != std::string::npos && slash + 1 < named.size()) {
    const Result<std::int64_t> found = findSeries(*index, study->id, named.substr(slash + 1));
    if (!found) return found.error();
    series = *found;
  }
  Result<std::vector<std::string>> files = index->files(study->id, series);
  const Result<std::vector<std::string>> refused = index->refusedBeside(study->id, series);
  if (!refused) return refused.error();
  if (files) files->insert(files->end(), refused->begin(), refused->end());
  return files;
}

Result<std::vector<std::string>> filesOfIndexPath(const std::string& path) {
  const Result<std::vector<std::string>> files = filesOf(path.substr(prefix.size()));
  if (!files) return Error{path + ": " + files.message()};
  return files;
}

}  // namespace

bool isStudyName(const std::string& path) {
  return isPhantom(path) || path.starts_with(prefix) || path.starts_with(archivePrefix);
}

Result<std::vector<std::string>> filesOfPath(const std::string& path, const Progress& progress,
                                             const CancelToken& cancel) {
  if (path.starts_with(archivePrefix)) return fetchPath(path, progress, cancel);
  if (path.starts_with(prefix)) return filesOfIndexPath(path);
  auto found = findFiles(path, cancel);
  if (!found) return found.error();
  return std::move(found->files);
}

Result<Study> openPath(const std::string& path, const Progress& progress, const CancelToken& cancel) {
  if (!path.starts_with(archivePrefix) && !path.starts_with(prefix)) {
    Result<Study> study = openStudy(path, progress, cancel);
    if (study) useFetched(*study);
    return study;
  }
  const Result<std::vector<std::string>> files = filesOfPath(path, progress, cancel);
  if (!files) return files.error();
  useFetched(*files);
  Result<Study> study = openFiles(*files, progress, cancel);
  return study ? std::move(study) : Error{path + ": interrupted."};
}

}  // namespace volumen
