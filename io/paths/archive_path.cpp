#include "io/paths/archive_path.h"

#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "io/index/index.h"

namespace volumen {

namespace {

Result<std::vector<std::string>> fetchNamed(const std::string& name, FetchRequest request,
                                            const Progress& progress, const CancelToken& cancel) {
  const std::string list = userArchivesFile(), index = userIndexFolder();
  const auto archives = readArchives(list);
  if (!archives) return archives.error();
  const auto archive = archiveNamed(*archives, name, list);
  if (!archive) return archive.error();
  if (index.empty()) return Error{"There is no home folder to fetch into: set HOME or XDG_DATA_HOME."};
  request.folder = fetchedFolder(index, request.studyUid);
  request.isManaged = true;
  const auto report = fetchFromArchive(*archive, request, progress, cancel);
  if (!report) return report.error();
  if (!report->isAll())
    return Error{"Only " + std::to_string(report->fetched + report->alreadyHere) + " of " +
                 std::to_string(report->expected) + " images could be fetched. " +
                 (report->problems.empty() ? "" : report->problems.front())};
  if (const auto trimmed = trimFetched(index, mostBytesFetched(*archive)); !trimmed) return trimmed.error();
  return filesFetched(request);
}

}  // namespace

Result<std::vector<std::string>> fetchPath(const std::string& path, const Progress& progress,
                                           const CancelToken& cancel) {
  const std::string named = path.substr(path.find(':') + 1);
  const std::size_t name = named.find('/');
  FetchRequest request = requestFor(name == std::string::npos ? "" : named.substr(name + 1));
  if (request.studyUid.empty())
    return Error{path + ": name a study by its UID, archive:NAME/STUDY; `volumen archive query " +
                 named.substr(0, name) + "` lists them."};
  auto files = fetchNamed(named.substr(0, name), std::move(request), progress, cancel);
  if (!files) return Error{path + ": " + files.message()};
  return files;
}

}  // namespace volumen
