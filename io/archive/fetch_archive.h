#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "io/archive/archives.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What is fetched from an archive: a study, or one of its series.
struct FetchRequest {
  std::string studyUid;
  std::string seriesUid;   ///< empty: all
  std::string folder;      ///< files go to folders of their series in it, named by us
  bool isManaged = false;  ///< that is fetchedFolder(): trimFetched() may remove the study later
};

/// Returns the request for "STUDY" or "STUDY/SERIES", as a user names them by UIDs.
FetchRequest requestFor(const std::string& named);

struct FetchReport {
  int expected = 0;     ///< instances that the archive lists, or says that it has
  int fetched = 0;      ///< of them
  int alreadyHere = 0;  ///< of them, fetched before
  bool isAll() const { return fetched + alreadyHere >= expected && missing.empty(); }
  std::uint64_t bytes = 0;
  std::vector<std::string> missing;   ///< SOP Instance UIDs of the others, as far as they are listed
  std::vector<std::string> problems;  ///< why some are missing, sentences
};

/// A series with all of its images that the archive sent.
struct FetchedSeries {
  std::string uid;
  FetchReport report;                ///< of this series alone
  std::set<std::string> modalities;  ///< of all series that are fetched
};
using OnSeries = std::function<void(const FetchedSeries& series)>;

/// Returns the folder for what archives send, beside the index in `indexFolder`, or that of one study in it.
std::string fetchedFolder(const std::string& indexFolder);
std::string fetchedFolder(const std::string& indexFolder, const std::string& studyUid);

/// Returns the folder of a request's study or series.
std::string folderOf(const FetchRequest& request);

/// Returns the files that are there of a request.
std::vector<std::string> filesFetched(const FetchRequest& request);

/// Fetches a study over associations of its own (C-GET), each instance with the bytes that the archive holds.
/// Series come one after the other, the pictures with most images first, the others by their numbers; each is
/// told to `onSeries`. Instances that are in the folder are not fetched again, so that an interrupted fetch
/// continues. The Error: nothing could be fetched, or this computer cannot go on.
Result<FetchReport> fetchFromArchive(const Archive& archive, const FetchRequest& request,
                                     const Progress& progress, const CancelToken& cancel,
                                     const OnSeries& onSeries = {});

}  // namespace volumen
