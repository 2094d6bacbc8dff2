#include "ui/controller/archive_source.h"

#include <QLocale>
#include <utility>

#include "io/archive/search_archive.h"
#include "ui/workspace/indexed_text.h"

namespace volumen {

namespace {

constexpr int lookEveryMs = 100, longestMs = 1000;
constexpr int lookAtArrivalMs = 250;  // what comes within this time is shown when it is complete

// Returns a sentence on how many studies a search has found so far.
QString soFarText(const QString& archive, std::size_t studies) {
  if (studies == 1) return ArchiveSource::tr("Searching %1: 1 study so far.").arg(archive);
  return ArchiveSource::tr("Searching %1: %2 studies so far.").arg(archive, countText(int(studies)));
}

std::vector<IndexedStudy> studiesIn(ArchiveAnswers&& answers) {
  std::vector<IndexedStudy> studies;
  for (ArchiveStudy& one : answers.studies) studies.push_back(std::move(one.study));
  return studies;
}

}  // namespace

ArchiveSource::ImagesHere ArchiveSource::imagesHere(const std::string& indexFolder) {
  auto here = std::make_shared<std::map<std::string, int>>();
  const Result<Index> index = Index::openAsItIs(indexFolder);
  if (!index) return here;
  const Result<std::vector<IndexedStudy>> studies = index->studies();
  if (!studies) return here;
  for (const IndexedStudy& study : *studies)
    if (!study.offline) (*here)[study.studyUid] += study.images;
  return here;
}

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

ArchiveSource::ArchiveSource(Archive archive, std::string indexFolder, Jobs& jobs, QObject* parent)
    : StudySource(parent),
      archive_(std::move(archive)),
      indexFolder_(std::move(indexFolder)),
      searches_(&jobs),
      questions_(&jobs),
      fetches_(&jobs),
      seriesFetches_(&jobs) {
  look_.setInterval(lookEveryMs);
  connect(&look_, &QTimer::timeout, this, &ArchiveSource::takeIncoming);
  lookAtArrival_.setInterval(lookAtArrivalMs);
  connect(&lookAtArrival_, &QTimer::timeout, this, &ArchiveSource::lookAtArrival);
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
  newestHere_.reset();
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
    if (!here) here = imagesHere(indexFolder_);
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
    here = newestHere_ ? newestHere_ : incoming_->here;
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
  answer_ = Answer{words,
                   {studies},
                   studies->size(),
                   newestHere_ ? newestHere_ : found.here,
                   notices.join(QLatin1Char(' ')),
                   true};
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
        return studiesOfArchivedPatient(archive, patientId, patientName, job.cancel());
      },
      [this, answer](Result<std::vector<IndexedStudy>> found) {
        answer(found ? std::optional(numbered(std::move(*found))) : std::nullopt);
      },
      [answer] { answer({}); });
}

}  // namespace volumen
