// How an archive's studies are opened: fetched, imported, and found on this computer.
#include <set>

#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "ui/controller/archive_source.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

// The Error: the files are not in the index.
Status addToIndex(const std::string& indexFolder, const std::string& folder) {
  Result<Index> index = Index::open(indexFolder);
  if (!index) return index.error();
  const Result<ImportReport> imported = index->import({folder});
  return imported ? Status() : imported.error();
}

// Returns how many images are missing, and why; empty for none.
QString missingText(const FetchReport& report) {
  if (report.isAll()) return {};
  const QString why = report.problems.empty() ? QString() : QString::fromStdString(report.problems.front());
  return ArchiveSource::tr("%1 of %2 images are missing. %3")
      .arg(countText(report.expected - report.fetched - report.alreadyHere), countText(report.expected), why)
      .trimmed();
}

}  // namespace

struct ArchiveSource::Fetched {
  std::string folder;
  std::vector<std::string> files;  // of all that was opened of the study
  QString problem;                 // why some are missing; empty for none
};

void ArchiveSource::open(const IndexedChoice& choice, OpenHow how) {
  const std::string studyUid = studies_.uidOf(choice.study);
  if (studyUid.empty())
    return Q_EMIT notOpened(choice, tr("This study is not in the list of %1.").arg(name()));
  OpenIntent intent;
  intent.how = how;
  intent.seriesUid = series_.uidOf(choice.series);
  fetches_.run(
      JobName(tr("Fetching"), patientNameText(patientNames_[choice.study])),
      [this, archive = archive_, studyUid, seriesUid = intent.seriesUid](const Job& job) {
        return fetch(archive, studyUid, seriesUid, job);
      },
      [this, choice, intent](const Result<Fetched>& fetched) {
        if (!fetched) return Q_EMIT notOpened(choice, QString::fromStdString(fetched.message()));
        Q_EMIT filesFound(choice, fetched->files, intent);
        importInto(fetched->folder);
        if (!fetched->problem.isEmpty()) Q_EMIT failed(fetched->problem);
      });
}

// The study is opened meanwhile. An import that has begun is brought to its end.
void ArchiveSource::importInto(const std::string& folder) {
  imports_.run(
      {},
      [index = indexFolder_, folder, most = mostBytesFetched(archive_)](const Job&) -> Result<ImagesHere> {
        if (Status added = addToIndex(index, folder); !added) return added.error();
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

// Runs on the thread of `fetches_`. Series that were opened before stay open: their files belong to the
// study.
Result<ArchiveSource::Fetched> ArchiveSource::fetch(const Archive& archive, const std::string& studyUid,
                                                    const std::string& seriesUid, const Job& job) {
  if (indexFolder_.empty())
    return Error{tr("There is no home folder for fetched studies: set HOME or XDG_DATA_HOME.").toStdString()};
  const FetchRequest request{studyUid, seriesUid, fetchedFolder(indexFolder_, studyUid), true};
  const Progress progress = [&](const char*, std::size_t done, std::size_t total) {
    job.tell(tr("image %1 of %2").arg(countText(int(done)), countText(int(total))),
             double(done) / double(total));
  };
  const Result<FetchReport> report = fetchFromArchive(archive, request, progress, job.cancel());
  if (!report) return report.error();
  if (report->fetched + report->alreadyHere == 0)
    return Error{
        tr("The archive \"%1\" sent no images.").arg(QString::fromStdString(archive.name)).toStdString()};
  Fetched fetched{folderOf(request), {}, missingText(*report)};
  std::set<std::string> files;
  opened_[studyUid].insert(seriesUid);
  for (const std::string& series : opened_[studyUid])
    for (std::string& file : filesFetched({studyUid, series, request.folder})) files.insert(std::move(file));
  fetched.files.assign(files.begin(), files.end());
  return fetched;
}

}  // namespace volumen
