#include "io/archive/receive_into_index.h"

#include <chrono>
#include <future>
#include <map>
#include <mutex>
#include <vector>

#include "io/archive/fetch_archive.h"

namespace volumen {

namespace {

using Clock = std::chrono::steady_clock;

// The folders of studies that are not in the index yet.
class Arrivals {
 public:
  void note(const std::string& studyFolder) {
    const std::scoped_lock one(mutex_);
    const auto now = Clock::now();
    times_.try_emplace(studyFolder, Times{now, now}).first->second.last = now;
  }
  // Returns those whose last instance came `quiet` ago or earlier, or that have waited for long, and forgets
  // them.
  std::vector<std::string> take(Clock::duration quiet) {
    constexpr std::chrono::seconds mostWait{30};
    const std::scoped_lock one(mutex_);
    std::vector<std::string> folders;
    std::erase_if(times_, [&, now = Clock::now()](const auto& arrival) {
      if (arrival.second.last > now - quiet && arrival.second.first > now - mostWait) return false;
      folders.push_back(arrival.first);
      return true;
    });
    return folders;
  }

 private:
  std::mutex mutex_;
  struct Times {
    Clock::time_point first, last;
  };
  std::map<std::string, Times> times_;
};

}  // namespace

Result<ReceiveReport> receiveIntoIndex(const Listening& listening, const std::string& indexFolder,
                                       const ReceiveEvents& events,
                                       const std::function<void(const Result<ImportReport>&)>& onImported,
                                       const CancelToken& cancel) {
  constexpr std::chrono::milliseconds glance{250};
  constexpr std::chrono::seconds quiet{2};
  Result<Index> index = Index::open(indexFolder);
  if (!index) return index.error();
  Arrivals arrivals;
  ReceiveEvents noted = events;
  noted.onStored = [&](const Received& one) {
    arrivals.note(one.studyFolder);
    if (events.onStored) events.onStored(one);
  };
  const auto add = [&](Clock::duration since) {
    const auto folders = arrivals.take(since);
    if (folders.empty()) return;
    const auto imported = index->import(folders);
    onImported(imported);
    if (!imported)
      for (const std::string& folder : folders) arrivals.note(folder);
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
