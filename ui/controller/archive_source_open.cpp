// How an archive's studies are opened: fetched, imported, and found on this computer.
#include <algorithm>
#include <set>

#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "ui/controller/archive_source.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

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

}  // namespace

struct ArchiveSource::Opening {
  Archive archive;
  IndexedChoice choice;
  std::string studyUid;
  OpenIntent intent;
};

struct ArchiveSource::Fetched {
  std::string folder, seriesUid;   // no UID: of all series
  std::vector<std::string> files;  // none: they were told before
  QString problem;                 // why some are missing; empty for none
};

void ArchiveSource::open(const IndexedChoice& choice, OpenHow how) {
  Opening opening{archive_, choice, studies_.uidOf(choice.study), {}};
  if (opening.studyUid.empty())
    return Q_EMIT notOpened(choice, tr("This study is not in the list of %1.").arg(name()));
  opening.intent.how = how;
  opening.intent.seriesUid = series_.uidOf(choice.series);
  JobLane& lane = opening.intent.seriesUid.empty() ? fetches_ : seriesFetches_;
  lane.run(
      JobName(tr("Fetching"), patientNameText(patientNames_[choice.study])),
      [this, opening](const Job& job) { return fetch(opening, job); },
      [this, opening](const Result<Fetched>& fetched) {
        if (!fetched) return Q_EMIT notOpened(opening.choice, QString::fromStdString(fetched.message()));
        take(opening, *fetched);
      });
}

// Series that were opened before stay open: their files belong to the study.
void ArchiveSource::take(const Opening& opening, const Fetched& fetched) {
  if (!fetched.files.empty()) {
    auto& opened = opened_[opening.studyUid];
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
  const auto& [archive, choice, studyUid, intent] = opening;
  const FetchRequest request{studyUid, intent.seriesUid, fetchedFolder(indexFolder_, studyUid), true};
  const Progress progress = [&](const char*, std::size_t done, std::size_t total) {
    job.tell(tr("image %1 of %2").arg(countText(int(done)), countText(int(total))),
             double(done) / double(total));
  };
  const bool isWhole = !intent.seriesUid.empty() || intent.how == OpenHow::lookedInto;
  Opening next = opening;
  bool isTold = false;
  int missingTold = 0;
  const OnSeries onSeries = [&](const FetchedSeries& series) {
    if (isWhole || isShownAsWhole(series.modalities)) return;
    const FetchRequest one{studyUid, series.uid, request.folder};
    const Fetched some{folderOf(one), series.uid, filesFetched(one), missingText(series.report)};
    fetches_.tell(job, [this, next, some] { take(next, some); });
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
