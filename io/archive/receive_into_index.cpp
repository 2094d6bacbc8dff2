#include "io/archive/receive_into_index.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <mutex>
#include <vector>

#include "io/archive/fetch_archive.h"
#include "io/files/name_for_uid.h"
#include "io/files/private_folder.h"

namespace volumen {

namespace {

using Clock = std::chrono::steady_clock;

// The studies that are not in the index yet, each marked by an empty file beside the index: if the program is
// killed, the next one finds the marks.
class Arrivals {
 public:
  explicit Arrivals(const std::string& indexFolder)
      : marks_(indexFolder + "/arrived"), studies_(fetchedFolder(indexFolder)) {}

  // Makes the folder of the marks, and notes the studies that have one.
  Status begin() {
    if (Status s = makePrivateFolder(marks_); !s) return s;
    for (const std::string& study : marked()) times_.emplace(study, Times{});
    return {};
  }
  void note(const std::string& studyUid) {
    const std::string study = nameForUid(studyUid);
    const std::scoped_lock one(mutex_);
    const auto now = Clock::now();
    const auto [times, isNew] = times_.try_emplace(study, Times{now, now});
    times->second.last = now;
    if (isNew) std::ofstream(marks_ + "/" + study).flush();
  }
  // Returns the studies whose last instance came `quiet` ago or earlier, or that have waited for long, and
  // forgets them.
  std::vector<std::string> take(Clock::duration quiet) {
    constexpr std::chrono::seconds mostWait{30};
    const std::scoped_lock one(mutex_);
    std::vector<std::string> studies;
    std::erase_if(times_, [&, now = Clock::now()](const auto& arrival) {
      if (arrival.second.last > now - quiet && arrival.second.first > now - mostWait) return false;
      studies.push_back(arrival.first);
      return true;
    });
    return studies;
  }
  // Imports studies that were taken. Those of which nothing came meanwhile lose their marks.
  Result<ImportReport> import(Index& index, const std::vector<std::string>& studies,
                              const CancelToken& cancel) {
    std::vector<std::string> folders;
    std::error_code ignored;
    for (const std::string& study : studies)
      if (std::filesystem::is_directory(studies_ + "/" + study, ignored))
        folders.push_back(studies_ + "/" + study);
    Result<ImportReport> imported = index.import(folders, {}, cancel);
    const bool isDone = imported && !imported->cancelled;
    const std::scoped_lock one(mutex_);
    for (const std::string& study : studies)
      if (!isDone)
        times_.emplace(study, Times{Clock::now(), Clock::now()});
      else if (!times_.contains(study))
        std::filesystem::remove(marks_ + "/" + study, ignored);
    return imported;
  }

 private:
  std::vector<std::string> marked() const {
    std::vector<std::string> studies;
    std::error_code ignored;
    for (const auto& mark : std::filesystem::directory_iterator(marks_, ignored))
      studies.push_back(mark.path().filename().string());
    return studies;
  }

  struct Times {
    Clock::time_point first, last;
  };
  const std::string marks_, studies_;
  std::mutex mutex_;
  std::map<std::string, Times> times_;  // by names of folders
};

}  // namespace

Result<ImportReport> importArrived(const std::string& indexFolder, const CancelToken& cancel) {
  std::error_code ignored;
  if (std::filesystem::is_empty(indexFolder + "/arrived", ignored) || ignored) return ImportReport{};
  Arrivals arrivals(indexFolder);
  if (Status s = arrivals.begin(); !s) return s.error();
  Result<Index> index = Index::open(indexFolder);
  if (!index) return index.error();
  return arrivals.import(*index, arrivals.take({}), cancel);
}

Result<ReceiveReport> receiveIntoIndex(const Listening& listening, const std::string& indexFolder,
                                       const ReceiveEvents& events,
                                       const std::function<void(const Result<ImportReport>&)>& onImported,
                                       const CancelToken& cancel) {
  constexpr std::chrono::milliseconds glance{250};
  constexpr std::chrono::seconds quiet{2};
  Result<Index> index = Index::open(indexFolder);
  if (!index) return index.error();
  Arrivals arrivals(indexFolder);
  if (Status s = arrivals.begin(); !s) return s.error();
  ReceiveEvents noted = events;
  noted.wants = [&](const dicom::InstanceUids& uids) {
    if (events.wants && !events.wants(uids)) return false;
    arrivals.note(uids.study);
    return true;
  };
  noted.onStored = [&](const Received& one) {
    arrivals.note(one.studyUid);
    if (events.onStored) events.onStored(one);
  };
  const auto add = [&](Clock::duration since) {
    if (const auto studies = arrivals.take(since); !studies.empty())
      onImported(arrivals.import(*index, studies, {}));
  };
  // The index belongs to this thread, so another one listens.
  auto receiving = std::async(std::launch::async, [&] {
    return receiveInstances(listening, fetchedFolder(indexFolder), noted, cancel);
  });
  while (receiving.wait_for(glance) != std::future_status::ready) add(quiet);
  add({});
  return receiving.get();
}

}  // namespace volumen
