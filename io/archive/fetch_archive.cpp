#include "io/archive/fetch_archive.h"

#include <dcmtk/config/osconfig.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "io/archive/data_sets.h"
#include "io/archive/fetched_studies.h"
#include "io/archive/instance_folder.h"
#include "io/archive/protocol.h"
#include "io/files/name_for_uid.h"
#include "io/files/private_folder.h"

namespace volumen {

namespace {

constexpr std::size_t mostInstances = 200000;

struct ListedSeries {
  std::string modality;
  int number = -1;
  int told = -1;  // number of instances, if the archive tells it
  std::vector<ListedInstance> instances;

  int expected() const { return std::max(told, int(instances.size())); }
  bool hasPictures() const {
    static const std::set<std::string> others{"AU",  "DOC",    "KO",     "M3D",      "PLAN", "PR",
                                              "REG", "RTDOSE", "RTPLAN", "RTSTRUCT", "SEG",  "SR"};
    return !others.contains(modality);
  }
};

using SeriesByUid = std::map<std::string, ListedSeries>;

// Returns series in the order in which they come.
std::vector<SeriesByUid::const_iterator> inOrder(const SeriesByUid& all) {
  std::vector<SeriesByUid::const_iterator> ordered;
  for (auto one = all.begin(); one != all.end(); ++one) ordered.push_back(one);
  std::ranges::stable_sort(ordered, {}, [](const auto& one) { return one->second.number; });
  const auto first = std::ranges::max_element(ordered, {}, [](const auto& one) {
    return std::pair(one->second.hasPictures(), one->second.expected());
  });
  if (first != ordered.end()) std::rotate(ordered.begin(), first, first + 1);
  return ordered;
}

// Returns the series of a study with their instances, as the archive lists them.
class Listing {
 public:
  Listing(ArchiveProtocol& protocol, const Archive& archive, const FetchRequest& request)
      : protocol_(protocol), archive_(archive), request_(request) {}

  Result<SeriesByUid> operator()() {
    SeriesByUid all;
    DcmDataset keys = keysAt("SERIES", request_.studyUid);
    putKey(keys, DCM_SeriesInstanceUID, request_.seriesUid);
    askFor(keys, {DCM_Modality, DCM_SeriesNumber, DCM_NumberOfSeriesRelatedInstances});
    const Status listed = list(keys, [&](const Answer& answer) {
      const std::string uid = answer.text(DCM_SeriesInstanceUID);
      const bool isWanted = isOf(answer, DCM_StudyInstanceUID, request_.studyUid) &&
                            (request_.seriesUid.empty() || uid == request_.seriesUid);
      if (!uid.empty() && isWanted)
        all[uid] = {answer.text(DCM_Modality),
                    answer.count(DCM_SeriesNumber),
                    answer.count(DCM_NumberOfSeriesRelatedInstances),
                    {}};
      return all.size() < mostInstances;
    });
    if (!listed) return listed.error();
    for (auto& [uid, series] : all)
      if (Status s = addInstances(uid, series.instances); !s) return s.error();
    std::erase_if(all, [](const auto& series) { return series.second.instances.empty(); });
    return all;
  }

 private:
  // An archive that ignores a key answers with others, too.
  static bool isOf(const Answer& answer, const DcmTagKey& tag, const std::string& uid) {
    const std::string of = answer.text(tag);
    return of.empty() || of == uid;
  }

  Status addInstances(const std::string& seriesUid, std::vector<ListedInstance>& instances) {
    DcmDataset keys = keysAt("IMAGE", request_.studyUid);
    putKey(keys, DCM_SeriesInstanceUID, seriesUid);
    askFor(keys, {DCM_SOPInstanceUID, DCM_SOPClassUID});
    std::set<std::string> known;
    return list(keys, [&](const Answer& answer) {
      ListedInstance one{answer.text(DCM_SOPInstanceUID), answer.text(DCM_SOPClassUID)};
      if (!one.uid.empty() && isOf(answer, DCM_SeriesInstanceUID, seriesUid) && known.insert(one.uid).second)
        instances.push_back(std::move(one));
      return instances.size() < mostInstances;
    });
  }

  // The Error: a list that the archive ends early would count too few.
  Status list(DcmDataset& keys, const std::function<bool(const Answer&)>& onAnswer) {
    const auto end =
        protocol_.find(keys, [&](DcmDataset& data) { return onAnswer(Answer(data, archive_.characterSet)); });
    if (!end) return end.error();
    return end->early.empty() ? Status() : Error{end->early};
  }

  ArchiveProtocol& protocol_;
  const Archive& archive_;
  const FetchRequest& request_;
};

// Fetches the series of one study, one after the other.
class Fetch {
 public:
  Fetch(ArchiveProtocol& protocol, const Archive& archive, const FetchRequest& request,
        const Progress& progress, const CancelToken& cancel, const OnSeries& onSeries)
      : protocol_(protocol),
        archive_(archive),
        request_(request),
        progress_(progress),
        cancel_(cancel),
        onSeries_(onSeries) {}

  Result<FetchReport> operator()(const SeriesByUid& all) {
    std::set<std::string> modalities;
    for (const auto& [uid, series] : all) {
      expected_ += std::size_t(series.expected());
      modalities.insert(series.modality);
    }
    FetchReport total;
    for (const auto& one : inOrder(all)) {
      const Result<FetchReport> report = fetchSeries(one->first, one->second);
      if (!report) return report.error();
      add(*report, total);
      const bool isHere = report->fetched + report->alreadyHere > 0;
      if (isHere && onSeries_) onSeries_({one->first, *report, modalities});
    }
    if (total.fetched + total.alreadyHere == 0 && !total.problems.empty())
      return Error{total.problems.front()};
    return total;
  }

 private:
  static void add(const FetchReport& one, FetchReport& total) {
    total.expected += one.expected;
    total.fetched += one.fetched;
    total.alreadyHere += one.alreadyHere;
    total.bytes += one.bytes;
    total.missing.insert(total.missing.end(), one.missing.begin(), one.missing.end());
    for (const std::string& problem : one.problems)
      if (std::ranges::find(total.problems, problem) == total.problems.end())
        total.problems.push_back(problem);
  }

  // The Error: this computer cannot go on.
  Result<FetchReport> fetchSeries(const std::string& seriesUid, const ListedSeries& series) {
    FetchReport report;
    report.expected = series.expected();
    const std::string folder = request_.folder + "/" + nameForUid(seriesUid);
    if (Status s = makePrivateFolder(folder); !s) return s.error();
    const std::size_t most = 2 * series.instances.size() + 1000;
    InstanceFolder files(archive_.name, folder, request_.studyUid, seriesUid, most, [&] {
      if (progress_) progress_("fetching", ++stored_, expected_);
    });
    const int before = filesIn(folder);
    stored_ += std::size_t(before);
    report.alreadyHere = before;
    WantedInstances wanted{request_.studyUid, seriesUid, series.modality, series.instances};
    // Some lists are shorter than what there is: then all is asked for.
    if (series.told <= int(series.instances.size()) || before >= series.told)
      std::erase_if(wanted.instances, [&](const ListedInstance& one) { return files.has(one.uid); });
    wanted.isWhole = wanted.instances.size() == series.instances.size();
    if (wanted.instances.empty()) return report;
    const Status retrieved = protocol_.retrieve(wanted, files);
    if (Status s = makeNamesLast(folder); !s) return s.error();
    if (cancel_.cancelled()) return Error{"cancelled"};
    for (const ListedInstance& one : wanted.instances)
      if (!files.has(one.uid)) report.missing.push_back(one.uid);
    const int after = filesIn(folder);
    report.fetched = after - before;
    if (after < report.expected)
      report.problems.push_back(retrieved
                                    ? "The archive \"" + archive_.name + "\" did not send all that it lists."
                                    : retrieved.message());
    report.bytes = files.bytesWritten();
    return report;
  }

  static int filesIn(const std::string& folder) {
    int count = 0;
    std::error_code error;
    for (const auto& one : std::filesystem::directory_iterator(folder, error))
      count += one.path().extension() == ".dcm";
    return count;
  }

  ArchiveProtocol& protocol_;
  const Archive& archive_;
  const FetchRequest& request_;
  const Progress& progress_;
  const CancelToken& cancel_;
  const OnSeries& onSeries_;
  std::size_t stored_ = 0, expected_ = 0;
};

}  // namespace

FetchRequest requestFor(const std::string& named) {
  const std::size_t slash = named.find('/');
  return {named.substr(0, slash), slash == std::string::npos ? "" : named.substr(slash + 1), ""};
}

std::string fetchedFolder(const std::string& indexFolder) { return indexFolder + "/fetched"; }

std::string fetchedFolder(const std::string& indexFolder, const std::string& studyUid) {
  return fetchedFolder(indexFolder) + "/" + nameForUid(studyUid);
}

std::string folderOf(const FetchRequest& request) {
  return request.folder + (request.seriesUid.empty() ? "" : "/" + nameForUid(request.seriesUid));
}

std::vector<std::string> filesFetched(const FetchRequest& request) {
  std::vector<std::string> files;
  std::error_code error;
  std::filesystem::recursive_directory_iterator all(folderOf(request), error);
  for (; !error && all != std::filesystem::recursive_directory_iterator(); all.increment(error))
    if (all->path().extension() == ".dcm") files.push_back(all->path().string());
  return files;
}

Result<FetchReport> fetchFromArchive(const Archive& archive, const FetchRequest& request,
                                     const Progress& progress, const CancelToken& cancel,
                                     const OnSeries& onSeries) {
  const auto protocol = protocolOf(archive, cancel);
  const auto series = Listing(*protocol, archive, request)();
  if (!series) return series.error();
  if (series->empty())
    return Error{"The archive \"" + archive.name + "\" lists no images of this " +
                 (request.seriesUid.empty() ? "study." : "series.")};
  if (request.isManaged)
    if (Status s = beginFetched(request.folder, request.studyUid); !s) return s.error();
  return Fetch(*protocol, archive, request, progress, cancel, onSeries)(*series);
}

}  // namespace volumen
