#include "ui/controller/archive_source.h"

#include <QLocale>
#include <utility>

#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "io/archive/search_archive.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

// Returns the number of images in the index by UID of their study; nothing if there is no index.
std::map<std::string, int> imagesHere(const std::string& indexFolder) {
  std::map<std::string, int> here;
  const Result<Index> index = Index::openAsItIs(indexFolder);
  if (!index) return here;
  const Result<std::vector<IndexedStudy>> studies = index->studies();
  if (!studies) return here;
  for (const IndexedStudy& study : *studies)
    if (!study.offline) here[study.studyUid] += study.images;
  return here;
}

// The Error: the files are not in the index.
Status addToIndex(const std::string& indexFolder, const std::string& folder, const CancelToken& cancel) {
  Result<Index> index = Index::open(indexFolder);
  if (!index) return index.error();
  const Result<ImportReport> imported = index->import({folder}, {}, cancel);
  return imported ? Status() : imported.error();
}

QString numberText(std::size_t number) { return QLocale().toString(qulonglong(number)); }

// Returns how many images are missing, and why; empty for none.
QString missingText(const FetchReport& report) {
  if (report.isAll()) return {};
  const QString why = report.problems.empty() ? QString() : QString::fromStdString(report.problems.front());
  return ArchiveSource::tr("%1 of %2 images are missing. %3")
      .arg(numberText(std::size_t(report.expected - report.fetched - report.alreadyHere)),
           numberText(std::size_t(report.expected)), why)
      .trimmed();
}

std::vector<IndexedStudy> studiesIn(ArchiveAnswers&& answers) {
  std::vector<IndexedStudy> studies;
  for (ArchiveStudy& one : answers.studies) studies.push_back(std::move(one.study));
  return studies;
}

// Returns "CT, PT", sorted.
std::string modalitiesOf(const std::vector<IndexedSeries>& series) {
  std::set<std::string> sorted;
  for (const IndexedSeries& one : series) sorted.insert(one.modality);
  std::string all;
  for (const std::string& modality : sorted) all += (all.empty() ? "" : ", ") + modality;
  return all;
}

// Archives search for words, so the patient is compared here. Those that tell no modalities of a study are
// asked for its series.
Result<std::vector<IndexedStudy>> archivedStudiesOf(const Archive& archive, const std::string& id,
                                                    const std::string& name, const CancelToken& cancel) {
  ArchiveQuery query;
  query.words = id.empty() ? name : id;
  Result<ArchiveAnswers> answers = searchArchive(archive, query, {}, cancel);
  if (!answers) return answers.error();
  std::vector<IndexedStudy> studies = studiesIn(std::move(*answers));
  std::erase_if(studies, [&](const IndexedStudy& s) { return s.patientId != id || s.patientName != name; });
  for (IndexedStudy& study : studies) {
    if (!study.modalities.empty()) continue;
    const auto series = seriesOfArchiveStudy(archive, study.studyUid, cancel);
    if (!series) return series.error();
    study.modalities = modalitiesOf(*series);
  }
  return studies;
}

}  // namespace

std::int64_t UidNumbers::of(const std::string& uid) {
  const auto [known, isNew] = numbers_.try_emplace(uid, std::int64_t(uids_.size()) + 1);
  if (isNew) uids_.push_back(uid);
  return known->second;
}

std::string UidNumbers::uidOf(std::int64_t number) const {
  return number > 0 && std::size_t(number) <= uids_.size() ? uids_[std::size_t(number) - 1] : std::string();
}

struct ArchiveSource::Found {
  ArchiveAnswers answers;
  std::map<std::string, int> here;
};

struct ArchiveSource::Fetched {
  std::vector<std::string> files;
  QString problem;  // why some are missing, or not in the index; empty for none
};

ArchiveSource::ArchiveSource(Archive archive, std::string indexFolder, Jobs& jobs, QObject* parent)
    : StudySource(parent),
      archive_(std::move(archive)),
      indexFolder_(std::move(indexFolder)),
      searches_(&jobs),
      questions_(&jobs),
      fetches_(&jobs) {}

void ArchiveSource::setArchive(Archive archive) {
  if (archive == archive_) return;
  archive_ = std::move(archive);
  searches_.giveUpAll();
  answer_.reset();
  seriesOf_.clear();
  Q_EMIT changed();
}

// Another order of the last answer needs no new search.
void ArchiveSource::list(const StudyListRequest& request) {
  const bool isSameSearch = searches_.isBusy() && wanted_.words == request.words;
  const bool isAnswered = answer_ && answer_->words == request.words && wanted_.sort != request.sort;
  wanted_ = request;
  if (isSameSearch) return;
  searches_.giveUpAll();
  if (isAnswered) return tellAnswer();
  const std::string words = request.words;
  searches_.run(
      JobName(tr("Searching %1").arg(name())),
      [this, archive = archive_, words](const Job& job) { return find(archive, words, job); },
      [this, words](Result<Found> found) {
        if (found) return takeAnswer(words, std::move(*found));
        answer_.reset();
        Q_EMIT unavailable(QString::fromStdString(found.message()));
      },
      [this] {
        answer_.reset();
        Q_EMIT unavailable(tr("The search was cancelled. Press Return in the search line to search again."));
      });
}

// Runs on the thread of `searches_`.
Result<ArchiveSource::Found> ArchiveSource::find(const Archive& archive, const std::string& words,
                                                 const Job& job) const {
  ArchiveQuery query;
  query.words = words.empty() ? "today" : words;
  const auto onStudies = [&](std::size_t count) {
    job.tell(tr("Searching %1: %2 studies").arg(QString::fromStdString(archive.name), numberText(count)), -1);
  };
  Result<ArchiveAnswers> answers = searchArchive(archive, query, onStudies, job.cancel());
  if (!answers) return answers.error();
  return Found{std::move(*answers), imagesHere(indexFolder_)};
}

void ArchiveSource::takeAnswer(const std::string& words, Found found) {
  QStringList notices;
  if (words.empty())
    notices << (found.answers.studies.empty() ? tr("There are no studies of today.")
                                              : tr("Studies of today."))
            << tr("Type words to search the archive.");
  notices << QString::fromStdString(found.answers.incomplete);
  notices.removeAll(QString());
  answer_ = Answer{words, numbered(studiesIn(std::move(found.answers))), {}, notices.join(QLatin1Char(' '))};
  for (const IndexedStudy& study : answer_->studies)
    if (const auto here = found.here.find(study.studyUid); here != found.here.end())
      answer_->here[study.id] = here->second;
  seriesOf_.clear();
  tellAnswer();
}

void ArchiveSource::tellAnswer() {
  StudyList list = listedStudies(answer_->studies, wanted_.sort, 0);
  list.here = answer_->here;
  list.notice = answer_->notice;
  Q_EMIT listed(wanted_, std::make_shared<const StudyList>(std::move(list)));
}

std::vector<IndexedStudy> ArchiveSource::numbered(std::vector<IndexedStudy> studies) {
  for (IndexedStudy& study : studies) {
    study.id = studies_.of(study.studyUid);
    patientNames_[study.id] = study.patientName;
  }
  return studies;
}

// Lists ask again for what they know whenever they change. Answers come after the call.
void ArchiveSource::series(std::int64_t study) {
  if (const auto known = seriesOf_.find(study); known != seriesOf_.end()) {
    const auto answer = [this, study, series = known->second] { Q_EMIT seriesListed(study, series); };
    return void(QMetaObject::invokeMethod(this, answer, Qt::QueuedConnection));
  }
  questions_.run(
      {},
      [archive = archive_, uid = studies_.uidOf(study)](const Job& job) {
        return seriesOfArchiveStudy(archive, uid, job.cancel());
      },
      [this, study](Result<std::vector<IndexedSeries>> found) {
        if (!found) return Q_EMIT failed(QString::fromStdString(found.message()));
        takeSeries(study, std::move(*found));
      });
}

void ArchiveSource::takeSeries(std::int64_t study, std::vector<IndexedSeries> found) {
  for (IndexedSeries& one : found) one.id = series_.of(one.seriesUid);
  const auto all = std::make_shared<const std::vector<IndexedSeries>>(
      sortedSeries(std::move(found), {StudyColumn::name, true}));
  seriesOf_[study] = all;
  Q_EMIT seriesListed(study, all);
}

// Who looks for priors goes on with other sources if this one is cancelled.
void ArchiveSource::studiesOf(const std::string& patientId, const std::string& patientName) {
  const auto answer = [=, this](const std::optional<std::vector<IndexedStudy>>& studies) {
    Q_EMIT patientListed(patientId, patientName, studies);
  };
  if (patientId.empty() && patientName.empty()) return answer(std::vector<IndexedStudy>());
  questions_.run(
      JobName(tr("Searching %1").arg(name())),
      [=, archive = archive_](const Job& job) {
        return archivedStudiesOf(archive, patientId, patientName, job.cancel());
      },
      [this, answer](Result<std::vector<IndexedStudy>> found) {
        answer(found ? std::optional(numbered(std::move(*found))) : std::nullopt);
      },
      [answer] { answer({}); });
}

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
        Q_EMIT imported();
        if (!fetched->problem.isEmpty()) Q_EMIT failed(fetched->problem);
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
    job.tell(tr("image %1 of %2").arg(numberText(done), numberText(total)), double(done) / double(total));
  };
  const Result<FetchReport> report = fetchFromArchive(archive, request, progress, job.cancel());
  if (!report) return report.error();
  if (report->fetched + report->alreadyHere == 0)
    return Error{
        tr("The archive \"%1\" sent no images.").arg(QString::fromStdString(archive.name)).toStdString()};
  Fetched fetched{{}, missingText(*report)};
  job.tell(tr("adding to the list of studies"), -1);
  const Status added = addToIndex(indexFolder_, folderOf(request), job.cancel());
  if (!added && fetched.problem.isEmpty()) fetched.problem = QString::fromStdString(added.message());
  const auto removed = trimFetched(indexFolder_, mostBytesFetched(archive));
  if (!removed && fetched.problem.isEmpty()) fetched.problem = QString::fromStdString(removed.message());
  std::set<std::string> files;
  opened_[studyUid].insert(seriesUid);
  for (const std::string& series : opened_[studyUid])
    for (std::string& file : filesFetched({studyUid, series, request.folder})) files.insert(std::move(file));
  fetched.files.assign(files.begin(), files.end());
  return fetched;
}

}  // namespace volumen
