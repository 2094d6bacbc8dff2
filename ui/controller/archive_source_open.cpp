// How an archive's studies are opened: fetched, imported, and found on this computer.
#include <algorithm>
#include <set>

#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "io/open.h"
#include "io/study/frame_series.h"
#include "ui/controller/archive_source.h"
#include "ui/data/picture_stacks.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

constexpr int lookAfterMs = 250;     // what comes within this time is not looked at before it is complete
constexpr double lookGrowth = 1.25;  // all files are read at each look

int missingOf(const FetchReport& report) { return report.expected - report.fetched - report.alreadyHere; }

// Returns how many images are missing, and why; empty for none.
QString missingText(const FetchReport& report) {
  if (report.isAll()) return {};
  const QString why = report.problems.empty() ? QString() : QString::fromStdString(report.problems.front());
  return ArchiveSource::tr("%1 of %2 images are missing. %3")
      .arg(countText(missingOf(report)), countText(report.expected), why)
      .trimmed();
}

// Returns whether what is shown first depends on several series.
bool isShownAsWhole(const std::set<std::string>& modalities) {
  return std::ranges::any_of(modalities, [](const std::string& modality) {
    return modality == "PT" || modality == "MG" || modality == "CR" || modality == "DX";
  });
}

// Returns the series with most images that these files form; null if they hold none. It has a path of its own
// for each number of files: frames in memory are found by path and number, and the numbers of images change
// as more come.
std::shared_ptr<const Series> largestOf(const std::vector<std::string>& files, const CancelToken& cancel) {
  Result<Study> study = openFiles(files, {}, cancel);
  if (!study) return nullptr;
  const Study stacked = withPictureStacks(std::move(*study));
  std::vector<Series> all = frameSeries(stacked);
  all.insert(all.end(), stacked.volumes.begin(), stacked.volumes.end());
  const auto largest = std::ranges::max_element(all, {}, frameCount);
  if (largest == all.end() || frameCount(*largest) == 0) return nullptr;
  largest->path += "#" + std::to_string(files.size());
  return std::make_shared<const Series>(std::move(*largest));
}

}  // namespace

struct ArchiveSource::Opening {
  Archive archive;
  IndexedChoice choice;
  FetchRequest request;
  OpenIntent intent;
  std::shared_ptr<std::atomic<int>> came = std::make_shared<std::atomic<int>>(0);  // images here
};

struct ArchiveSource::Fetched {
  std::string folder, seriesUid;   // no UID: of all series
  std::vector<std::string> files;  // none: they were told before
  QString problem;                 // why some are missing; empty for none
};

void ArchiveSource::open(const IndexedChoice& choice, OpenHow how) {
  const std::string studyUid = studies_.uidOf(choice.study), seriesUid = series_.uidOf(choice.series);
  if (studyUid.empty())
    return Q_EMIT notOpened(choice, tr("This study is not in the list of %1.").arg(name()));
  Opening opening{archive_, choice, {studyUid, seriesUid, fetchedFolder(indexFolder_, studyUid), true}, {}};
  opening.intent.how = how;
  opening.intent.seriesUid = seriesUid;
  JobLane& lane = opening.intent.seriesUid.empty() ? fetches_ : seriesFetches_;
  lane.run(
      JobName(tr("Fetching"), patientNameText(patientNames_[choice.study])),
      [this, opening](const Job& job) { return fetch(opening, job); },
      [this, opening](const Result<Fetched>& fetched) {
        if (!fetched) Q_EMIT notOpened(opening.choice, QString::fromStdString(fetched.message()));
        if (fetched) take(opening, *fetched);
        endArrival(opening);
      },
      [this, opening] { endArrival(opening); });
  followArrival(opening);
}

// From now on what comes is shown, if it will replace what is shown.
void ArchiveSource::followArrival(const Opening& opening) {
  endArrival();
  if (opening.intent.how != OpenHow::here && opening.intent.how != OpenHow::instead) return;
  arrival_ = Arrival{opening.request, opening.came};
  lookAtArrival_.start();
}

// All files are read at each look, so the next one waits until there are more by a quarter.
void ArchiveSource::lookAtArrival() {
  const int came = *arrival_->came;
  if (arrivals_.isBusy() || came == 0 || came < arrival_->seen + arrival_->seen / 4 || came == arrival_->seen)
    return;
  arrival_->seen = came;
  arrivals_.run(
      {},
      [request = arrival_->request](const Job& job) {
        return largestOf(filesFetched(request), job.cancel());
      },
      [this](const std::shared_ptr<const Series>& part) {
        if (part) Q_EMIT arriving(part);
      });
}

void ArchiveSource::endArrival(const Opening& opening) {
  if (arrival_ && arrival_->came == opening.came) endArrival();
}

void ArchiveSource::endArrival() {
  if (!std::exchange(arrival_, {})) return;
  lookAtArrival_.stop();
  arrivals_.giveUpAll();
  Q_EMIT arriving(nullptr);
}

// Series that were opened before stay open: their files belong to the study.
void ArchiveSource::take(const Opening& opening, const Fetched& fetched) {
  if (!fetched.files.empty()) {
    auto& opened = opened_[opening.request.studyUid];
    opened[fetched.seriesUid] = fetched.files;
    std::set<std::string> files;
    for (const auto& [uid, ofSeries] : opened) files.insert(ofSeries.begin(), ofSeries.end());
    Q_EMIT filesFound(opening.choice, {files.begin(), files.end()}, opening.intent);
    importInto(fetched.folder);
  }
  if (!fetched.problem.isEmpty()) Q_EMIT failed(fetched.problem);
}

// What came is opened meanwhile. An import that has begun is brought to its end.
void ArchiveSource::importInto(const std::string& folder) {
  imports_.run(
      {},
      [index = indexFolder_, folder, most = mostBytesFetched(archive_)](const Job&) -> Result<ImagesHere> {
        if (const auto imported = importIntoIndex(index, {folder}); !imported) return imported.error();
        if (auto removed = trimFetched(index, most); !removed) return removed.error();
        return imagesHere(index);
      },
      [this](const Result<ImagesHere>& here) {
        if (!here) return Q_EMIT failed(QString::fromStdString(here.message()));
        newestHere_ = *here;
        if (answer_) {
          answer_->here = *here;
          tellAnswer();
        }
        Q_EMIT imported();
      });
}

// This function runs on a background thread: that of `fetches_` or `seriesFetches_`.
Result<ArchiveSource::Fetched> ArchiveSource::fetch(const Opening& opening, const Job& job) {
  if (indexFolder_.empty())
    return Error{tr("There is no home folder for fetched studies: set HOME or XDG_DATA_HOME.").toStdString()};
  const auto& [archive, choice, request, intent, came] = opening;
  const bool isWhole = !intent.seriesUid.empty() || intent.how == OpenHow::lookedInto;
  Opening next = opening;
  bool isTold = false;
  int missingTold = 0;
  const Progress progress = [&](const char*, std::size_t done, std::size_t total) {
    job.tell(tr("image %1 of %2").arg(countText(int(done)), countText(int(total))),
             double(done) / double(total));
    *came = int(done);
  };
  const OnSeries onSeries = [&](const FetchedSeries& series) {
    if (isWhole || isShownAsWhole(series.modalities)) return;
    const FetchRequest one{request.studyUid, series.uid, request.folder};
    const Fetched some{folderOf(one), series.uid, filesFetched(one), missingText(series.report)};
    fetches_.tell(job, [this, next, some] {
      take(next, some);
      endArrival(next);
    });
    next.intent.how = OpenHow::joining;
    isTold = true;
    missingTold += missingOf(series.report);
  };
  const Result<FetchReport> report = fetchFromArchive(archive, request, progress, job.cancel(), onSeries);
  if (!report) return report.error();
  if (report->fetched + report->alreadyHere == 0)
    return Error{
        tr("The archive \"%1\" sent no images.").arg(QString::fromStdString(archive.name)).toStdString()};
  if (isTold) return Fetched{{}, {}, {}, missingOf(*report) > missingTold ? missingText(*report) : QString()};
  return Fetched{folderOf(request), intent.seriesUid, filesFetched(request), missingText(*report)};
}

}  // namespace volumen
