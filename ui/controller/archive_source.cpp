#include "ui/controller/archive_source.h"

#include <QLocale>
#include <utility>

#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "io/archive/search_archive.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

constexpr int lookEveryMs = 100, longestMs = 1000;

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

QString numberText(std::size_t number) { return QLocale().toString(qulonglong(number)); }

// Tells how far the search of an archive is.
QString soFarText(const QString& archive, std::size_t studies) {
  if (studies == 1) return ArchiveSource::tr("Searching %1: 1 study so far.").arg(archive);
  return ArchiveSource::tr("Searching %1: %2 studies so far.").arg(archive, numberText(studies));
}

// The Error: the files are not in the index.
Status addToIndex(const std::string& indexFolder, const std::string& folder, const CancelToken& cancel) {
  Result<Index> index = Index::open(indexFolder);
  if (!index) return index.error();
  const Result<ImportReport> imported = index->import({folder}, {}, cancel);
  return imported ? Status() : imported.error();
}

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
  ImagesHere here;
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
      fetches_(&jobs) {
  look_.setInterval(lookEveryMs);
  connect(&look_, &QTimer::timeout, this, &ArchiveSource::takeIncoming);
}

void ArchiveSource::setArchive(Archive archive) {
  if (archive == archive_) return;
  archive_ = std::move(archive);
  giveUpSearch();
  lists_.giveUpAll();
  answer_.reset();
  seriesOf_.clear();
  Q_EMIT changed();
}

// Another order of what is known needs no new search.
void ArchiveSource::list(const StudyListRequest& request) {
  const StudyListRequest before = std::exchange(wanted_, request);
  const bool isKnown = answer_ && answer_->words == request.words;
  const bool isSearched = searches_.isBusy() && before.words == request.words;
  if (!isSearched) giveUpSearch();
  if (isKnown && (isSearched || before.sort != request.sort)) return tellAnswer();
  if (isSearched) return;
  if (!isKnown || !answer_->isWhole) answer_.reset();  // a whole list stays until there is a new one
  search(request.words);
}

void ArchiveSource::giveUpSearch() {
  searches_.giveUpAll();
  look_.stop();
}

void ArchiveSource::search(const std::string& words) {
  seriesOf_.clear();
  incoming_ = std::make_shared<Incoming>();
  look_.start();
  sinceTaken_.start();
  searches_.run(
      JobName(tr("Searching %1").arg(name())),
      [this, archive = archive_, words, incoming = incoming_](const Job& job) {
        return find(archive, words, *incoming, job);
      },
      [this, words](Result<Found> found) {
        if (found) return takeAnswer(words, std::move(*found));
        endSearch(QString::fromStdString(found.message()));
      },
      [this] {
        endSearch(tr("The search of %1 was cancelled. Press Return in the search line to search again.")
                      .arg(name()));
      });
}

// Runs on the thread of `searches_`.
Result<ArchiveSource::Found> ArchiveSource::find(const Archive& archive, const std::string& words,
                                                 Incoming& incoming, const Job& job) const {
  ArchiveQuery query;
  query.words = words.empty() ? "today" : words;
  ImagesHere here;
  const auto knowsHere = [&] {
    if (!here) here = std::make_shared<const std::map<std::string, int>>(imagesHere(indexFolder_));
    return here;
  };
  std::size_t count = 0;
  const auto onStudy = [&](const IndexedStudy& study) {
    job.tell(soFarText(QString::fromStdString(archive.name), ++count), -1);
    knowsHere();
    const std::lock_guard lock(incoming.mutex);
    incoming.studies.push_back(study);
    incoming.here = here;
  };
  Result<ArchiveAnswers> answers = searchArchive(archive, query, onStudy, job.cancel());
  if (!answers) return answers.error();
  return Found{std::move(*answers), knowsHere()};
}

// Lists what came meanwhile, if it is much or nothing was listed for a while: each list is sorted anew.
void ArchiveSource::takeIncoming() {
  if (answer_ && answer_->isWhole) return;
  const std::size_t listed = answer_ ? answer_->count : 0;
  std::vector<IndexedStudy> studies;
  ImagesHere here;
  {
    const std::lock_guard lock(incoming_->mutex);
    const bool isMuch = incoming_->studies.size() >= listed / 4;
    if (isMuch || !look_.isActive() || sinceTaken_.hasExpired(longestMs)) studies.swap(incoming_->studies);
    here = incoming_->here;
  }
  if (studies.empty()) return;
  if (!answer_) answer_ = Answer{wanted_.words, {}, 0, here, {}};
  answer_->count += studies.size();
  answer_->studies.push_back(std::make_shared<const std::vector<IndexedStudy>>(numbered(std::move(studies))));
  answer_->notice = soFarText(name(), answer_->count);
  sinceTaken_.start();
  tellAnswer();
}

void ArchiveSource::takeAnswer(const std::string& words, Found found) {
  look_.stop();
  QStringList notices;
  if (words.empty())
    notices << (found.answers.studies.empty() ? tr("There are no studies of today.")
                                              : tr("Studies of today."))
            << tr("Type words to search the archive.");
  notices << QString::fromStdString(found.answers.incomplete);
  notices.removeAll(QString());
  const auto studies =
      std::make_shared<const std::vector<IndexedStudy>>(numbered(studiesIn(std::move(found.answers))));
  answer_ = Answer{words, {studies}, studies->size(), found.here, notices.join(QLatin1Char(' ')), true};
  tellAnswer();
}

// What was found before a failure stays.
void ArchiveSource::endSearch(const QString& sentence) {
  look_.stop();
  takeIncoming();
  if (answer_ && !answer_->isWhole) {
    answer_->notice = tr("These are not all studies. %1").arg(sentence);
    return tellAnswer();
  }
  answer_.reset();
  lists_.giveUpAll();
  Q_EMIT unavailable(sentence);
}

StudyList ArchiveSource::listOf(const Answer& answer, const StudySort& sort) {
  std::vector<IndexedStudy> studies;
  for (const StudiesPtr& some : answer.studies) studies.insert(studies.end(), some->begin(), some->end());
  std::map<std::int64_t, int> here;
  for (const IndexedStudy& study : studies)
    if (const auto images = answer.here->find(study.studyUid); images != answer.here->end())
      here[study.id] = images->second;
  StudyList list = listedStudies(std::move(studies), sort, 0);
  list.here = std::move(here);
  list.notice = answer.notice;
  return list;
}

// Thousands of studies take a while to sort.
void ArchiveSource::tellAnswer() {
  isListOld_ = lists_.isBusy();
  if (isListOld_) return;
  lists_.run(
      {},
      [answer = *answer_, sort = wanted_.sort, isGrowing = searches_.isBusy()](const Job&) {
        StudyList list = listOf(answer, sort);
        list.isGrowing = isGrowing;
        return std::make_shared<const StudyList>(std::move(list));
      },
      [this, request = StudyListRequest{answer_->words, wanted_.sort}](const StudyListPtr& list) {
        Q_EMIT listed(request, list);
        if (isListOld_ && answer_) tellAnswer();
      });
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
