#include "ui/controller/all_sources.h"

#include <algorithm>
#include <map>
#include <utility>

namespace volumen {

namespace {

// Studies and series are numbered by their numbers in their source, and the number of the source.
constexpr std::int64_t mostSources = 1 << 16;

std::int64_t withSource(std::int64_t number, std::int64_t source) { return number * mostSources + source; }
std::int64_t sourceIn(std::int64_t number) { return number % mostSources; }
std::int64_t withoutSource(std::int64_t number) { return number / mostSources; }
IndexedChoice withoutSource(const IndexedChoice& choice) {
  return {withoutSource(choice.study), withoutSource(choice.series)};
}

// What one source lists.
struct PlacedList {
  StudyListPtr list;
  std::int64_t number;
  QString place;
};

StudyList joinedLists(const std::vector<PlacedList>& all, const StudySort& sort) {
  std::vector<IndexedStudy> studies;
  std::map<std::int64_t, int> here;
  std::map<std::int64_t, QString> places;
  std::size_t recent = 0;
  for (const PlacedList& one : all) {
    recent += one.list->recent.size();
    for (const ListedPatient& patient : one.list->patients)
      for (const IndexedStudy& study : patient.studies) {
        studies.push_back(study);
        studies.back().id = withSource(study.id, one.number);
        places[studies.back().id] = one.place;
      }
    for (const auto& [study, images] : one.list->here) here[withSource(study, one.number)] = images;
  }
  StudyList list = listedStudies(std::move(studies), sort, recent, std::move(places));
  list.here = std::move(here);
  return list;
}

}  // namespace

std::int64_t AllSources::numberOf(StudySource* source) {
  const auto known = std::ranges::find(known_, source);
  const std::int64_t number = known - known_.begin();
  if (known == known_.end()) {
    known_.push_back(source);
    listenTo(source, number);
  }
  return number;
}

void AllSources::listenTo(StudySource* source, std::int64_t number) {
  connect(source, &StudySource::listed, this,
          [this, source, number](const StudyListRequest& request, const StudyListPtr& list) {
            if (request == requestTo(*source)) take(number, list, {});
          });
  connect(source, &StudySource::unavailable, this,
          [this, number](const QString& sentence) { take(number, nullptr, sentence); });
  connect(source, &StudySource::changed, this, [this, number] {
    if (Part* part = partOf(number)) part->isAsked = false;
    Q_EMIT changed();
  });
  connect(source, &StudySource::seriesListed, this,
          [this, number](qint64 study, const SeriesListPtr& listed) {
            auto series = std::make_shared<std::vector<IndexedSeries>>(*listed);
            for (IndexedSeries& one : *series) one.id = withSource(one.id, number);
            Q_EMIT seriesListed(withSource(study, number), series);
          });
  connect(source, &StudySource::thumbnailMade, this, [this, number](qint64 series, const QImage& thumbnail) {
    Q_EMIT thumbnailMade(withSource(series, number), thumbnail);
  });
}

void AllSources::setOthers(const std::vector<StudySource*>& others) {
  if (std::ranges::equal(parts_, others, {}, &Part::source)) return;
  std::vector<Part> before = std::exchange(parts_, {});
  for (StudySource* source : others) {
    const auto known = std::ranges::find(before, source, &Part::source);
    parts_.push_back(known == before.end() ? Part{source, numberOf(source)} : std::move(*known));
  }
  Q_EMIT changed();
}

StudyListRequest AllSources::requestTo(const StudySource& source) const {
  const bool isOfToday = source.isRemote() && wanted_.words.empty();
  return isOfToday ? StudyListRequest{"today", wanted_.sort} : wanted_;
}

AllSources::Part* AllSources::partOf(std::int64_t number) {
  return const_cast<Part*>(std::as_const(*this).partOf(number));
}

// Returns null for a source that is no longer offered.
const AllSources::Part* AllSources::partOf(std::int64_t number) const {
  const auto found = std::ranges::find(parts_, number, &Part::number);
  return found == parts_.end() ? nullptr : &*found;
}

void AllSources::list(const StudyListRequest& request) {
  const bool isSame = wanted_ == request, isOfOtherWords = wanted_.words != request.words;
  const bool asksSome = isSame && std::ranges::any_of(parts_, [](const Part& part) { return !part.isAsked; });
  wanted_ = request;
  for (Part& part : parts_) {
    if (isOfOtherWords) part.list.reset();
    if (asksSome && part.isAsked) continue;
    part.problem.clear();
    part.isAsked = true;
    part.isAnswered = false;
    part.source->list(requestTo(*part.source));
  }
}

void AllSources::take(std::int64_t number, const StudyListPtr& list, const QString& problem) {
  Part* part = partOf(number);
  if (!part) return;
  part->list = list;
  part->problem = problem;
  part->isAnswered = !list || !list->isGrowing;
  tellList();
}

// Returns what is wrong first.
QString AllSources::notice() const {
  QStringList sentences, searching;
  for (const Part& part : parts_) {
    QString text = part.list ? part.list->notice : part.problem;
    const bool isSilent = !part.isAnswered && text.isEmpty() && part.source->isRemote();
    if (isSilent) text = tr("Searching %1...").arg(part.source->name());
    (part.isAnswered ? sentences : searching) << text;
  }
  if (wanted_.words.empty())
    sentences << tr("Archives list the studies of today. Type words to search them.");
  sentences << searching;
  sentences.removeAll(QString());
  return sentences.join(QLatin1Char(' '));
}

void AllSources::tellList() {
  isListOld_ = lists_.isBusy();
  if (isListOld_) return;
  std::vector<PlacedList> all;
  for (const Part& part : parts_)
    if (part.list) all.push_back({part.list, part.number, part.source->name()});
  const bool isGrowing = std::ranges::any_of(parts_, [](const Part& part) { return !part.isAnswered; });
  lists_.run(
      {},
      [all, sort = wanted_.sort, notice = notice(), isGrowing](const Job&) {
        StudyList list = joinedLists(all, sort);
        list.notice = notice;
        list.isGrowing = isGrowing;
        return std::make_shared<const StudyList>(std::move(list));
      },
      [this, request = wanted_](const StudyListPtr& list) {
        Q_EMIT listed(request, list);
        if (isListOld_) tellList();
      });
}

void AllSources::series(std::int64_t study) {
  known_[std::size_t(sourceIn(study))]->series(withoutSource(study));
}

// Each source cancels what it was asked for before.
void AllSources::wantThumbnails(const std::vector<std::int64_t>& series) {
  for (const Part& part : parts_) {
    std::vector<std::int64_t> own;
    for (const std::int64_t one : series)
      if (sourceIn(one) == part.number) own.push_back(withoutSource(one));
    part.source->wantThumbnails(own);
  }
}

void AllSources::open(const IndexedChoice& choice, OpenHow how) {
  if (const Part* part = partOf(sourceIn(choice.study)))
    return part->source->open(withoutSource(choice), how);
  Q_EMIT notOpened(choice, tr("The archive of this study is no longer in the list."));
}

ListFiles AllSources::filesOf(const IndexedChoice& choice) const {
  const Part* part = partOf(sourceIn(choice.study));
  return part ? part->source->filesOf(withoutSource(choice)) : ListFiles();
}

}  // namespace volumen
