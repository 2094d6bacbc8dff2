#include "ui/workspace/priors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <tuple>

#include "io/study/frame_series.h"
#include "results/series/series_facts.h"
#include "results/series/time_points.h"
#include "results/text/text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/links.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

bool isKnownPatient(const Series& series) { return !series.patientId.empty() || !series.patientName.empty(); }

// Returns whether two facts are equal or one of them is unknown.
bool mayBeSame(const std::string& a, const std::string& b) { return a.empty() || b.empty() || a == b; }

// Returns the words without numbers and without those too short to tell anything: "CT", "T1".
std::vector<std::string> tellingWords(const std::string& text) {
  std::vector<std::string> words = wordsOf(text);
  std::erase_if(words, [](const std::string& word) {
    return word.size() < 3 || word.find_first_not_of("0123456789") == std::string::npos;
  });
  return words;
}

// Returns whether the body parts agree or one of them is unknown.
bool mayBeOfOnePart(const Series& a, const Series& b) {
  return a.bodyPart.empty() || b.bodyPart.empty() || hasWord(a.bodyPart, b.bodyPart) ||
         hasWord(b.bodyPart, a.bodyPart);
}

bool isProjection(const Series& series) { return !acquiredPlaneOf(series); }

// Returns the points for two facts: all if they are equal, half if neither is known, else 0.
template <class T>
double pointsOf(double points, const std::optional<T>& a, const std::optional<T>& b) {
  if (!a && !b) return points / 2;
  return a == b ? points : 0;
}

double pointsOfWords(double points, const Series& a, const Series& b) {
  const std::vector<std::string> wordsA = wordsOf(a.description), wordsB = wordsOf(b.description);
  const std::set<std::string> inA(wordsA.begin(), wordsA.end()), inB(wordsB.begin(), wordsB.end());
  std::set<std::string> all = inA;
  all.insert(inB.begin(), inB.end());
  if (all.empty()) return points / 2;
  const auto shared = inA.size() + inB.size() - all.size();
  return points * double(shared) / double(all.size());
}

// Returns up to 30 points. PA and AP views show nearly the same.
double pointsOfProjection(const ProjectionView& a, const ProjectionView& b) {
  if (a == b) return 30;
  const bool areFrontal = isOneOf(a.viewPosition, "PA|AP") && isOneOf(b.viewPosition, "PA|AP");
  return areFrontal && a.laterality == b.laterality ? 25 : -30;
}

int seriesNumberOf(const Series& series) {
  int number = 1 << 30;
  const std::string& text = series.seriesNumber;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

SeriesPicture firstCompared(const Workspace& workspace) {
  for (const ViewId id : viewsInMain(workspace))
    if (const SeriesPicture picture = pictureIn(workspace, id)) return picture;
  return {};
}

// Returns the overlay of the first view; null if a view shows it by itself.
std::shared_ptr<const Series> seriesOverFirst(const Workspace& workspace) {
  const std::vector<ViewId> views = viewsInMain(workspace);
  const auto over = workspace.series.find(flatLookOf(workspace.view(views.front())).overlay);
  if (over == workspace.series.end()) return nullptr;
  const auto shows = [&](ViewId id) { return workspace.view(id).series == over->first; };
  return std::ranges::any_of(views, shows) ? nullptr : over->second.series;
}

// Shows a picture in a comparison view as it is read.
Workspace withPictures(Workspace workspace, ViewId view, const SeriesPicture& picture) {
  const Series& series = *picture.series;
  if (picture.frame < 0 && !opensAsPictures(series)) {
    ViewState& state = workspace.editView(view);
    if (state.kind != acquiredKind(series.acquired)) state.kind = usualKind(view), state.series = {};
    return withSeries(std::move(workspace), view, series, SceneLook());
  }
  workspace = withFrames(std::move(workspace), view, series);
  if (picture.frame >= 0) workspace.editView(view).flats.edit(keyOf(series)).frame = picture.frame;
  return workspace;
}

}  // namespace

std::vector<SeriesPicture> picturesOf(const std::vector<const Series*>& series) {
  std::vector<SeriesPicture> all;
  for (const Series* s : series) {
    if (!isOfProjections(*s)) {
      all.push_back({s});
      continue;
    }
    for (int n = 0; n < frameCount(*s); ++n)
      if (n == 0 || s->files[std::size_t(n)] != s->files[std::size_t(n) - 1] ||
          projectionOf(*s, n) != projectionOf(*s, n - 1))
        all.push_back({s, n});
  }
  return all;
}

SeriesPicture pictureIn(const Workspace& workspace, ViewId view) {
  const Series* series = seriesIn(workspace, view);
  const ViewState& state = workspace.view(view);
  if (!series || !showsFrames(state.kind) || !isOfProjections(*series)) return {series};
  return {series, flatLookOf(state).frame};
}

PatientStudies studiesAround(const std::vector<const Series*>& open, const Series& current) {
  PatientStudies studies;
  std::vector<const Series*> earlier;
  for (const Series* series : open)
    if (!areOfOnePatient(*series, current))
      continue;
    else if (series->studyUid == current.studyUid && series->studyDate == current.studyDate)
      studies.current.push_back(series);
    else if (isKnownPatient(current) && !series->studyDate.empty() && series->studyDate < current.studyDate)
      earlier.push_back(series);
  std::ranges::stable_sort(earlier, [](const Series* a, const Series* b) {
    return std::tie(b->studyDate, b->studyUid) < std::tie(a->studyDate, a->studyUid);
  });
  for (const Series* series : earlier) {
    const bool isNext = studies.priors.empty() || studies.priors.back()[0]->studyUid != series->studyUid ||
                        studies.priors.back()[0]->studyDate != series->studyDate;
    if (isNext) studies.priors.emplace_back();
    studies.priors.back().push_back(series);
  }
  return studies;
}

std::vector<std::vector<const Series*>> priorsOf(const PatientStudies& studies, const std::string& modality) {
  std::vector<std::vector<const Series*>> found = studies.priors;
  std::erase_if(found, [&](const std::vector<const Series*>& study) {
    return !modality.empty() &&
           std::ranges::none_of(study, [&](const Series* s) { return isOneOf(s->modality, modality); });
  });
  return found;
}

double likeness(const SeriesPicture& one, const SeriesPicture& other) {
  const Series &a = *one.series, &b = *other.series;
  if (a.modality != b.modality || !mayBeOfOnePart(a, b) || isProjection(a) != isProjection(b)) return 0;
  double points = 0;
  if (isProjection(a))
    points += pointsOfProjection(projectionOf(a, one.frame), projectionOf(b, other.frame));
  else
    points += acquiredPlaneOf(a) == acquiredPlaneOf(b) ? 30 : 0;
  points += a.modality == "CT" ? pointsOf(25, kernelOf(a), kernelOf(b))
                               : pointsOf(25, weightingOf(a), weightingOf(b));
  points += pointsOfWords(20, a, b) + pointsOf(15, contrastOf(a), contrastOf(b));
  const double thinner = std::min(a.sliceThickness, b.sliceThickness);
  const double thicker = std::max(a.sliceThickness, b.sliceThickness);
  points += thicker > 0 ? 10 * thinner / thicker : 5;
  return std::clamp(points, 0.0, 100.0);
}

SeriesPicture mostLike(const SeriesPicture& picture, const std::vector<const Series*>& among) {
  SeriesPicture best;
  double most = leastLikeness;
  for (const SeriesPicture& other : picturesOf(among)) {
    const double points = likeness(picture, other);
    const bool isFirst =
        best && points == most && seriesNumberOf(*other.series) < seriesNumberOf(*best.series);
    if (points > most || (!best && points >= most) || isFirst) best = other, most = points;
  }
  return best;
}

SeriesPicture priorOf(const SeriesPicture& picture, const std::vector<const Series*>& open) {
  for (const auto& prior : studiesAround(open, *picture.series).priors)
    if (const SeriesPicture found = mostLike(picture, prior)) return found;
  return {};
}

std::vector<const Series*> earlierOf(const Series& series, const std::vector<const Series*>& among,
                                     const std::string& after) {
  std::vector<const Series*> found;
  for (const Series* other : among)
    if (!series.patientId.empty() && areOfOnePatient(*other, series) &&
        mayBeSame(other->patientBirthDate, series.patientBirthDate) &&
        mayBeSame(other->patientSex, series.patientSex) && other->studyDate > after &&
        other->studyDate < series.studyDate)  // an empty date is never later
      found.push_back(other);
  return found;
}

std::vector<IndexedStudy> unopenedPriors(const Series& series, const std::vector<IndexedStudy>& listed,
                                         const std::vector<const Series*>& open, const std::string& after) {
  std::vector<IndexedStudy> found;
  if (series.patientId.empty()) return found;
  for (const IndexedStudy& study : listed) {
    const bool isOpen = std::ranges::any_of(open, [&](const Series* s) {
      return areOfOnePatient(*s, series) && s->studyUid == study.studyUid && s->studyDate == study.date;
    });
    const bool isOfPatient = study.patientId == series.patientId && study.patientName == series.patientName &&
                             mayBeSame(study.birthDate, series.patientBirthDate) &&
                             mayBeSame(study.sex, series.patientSex);
    const bool isBetween = study.date > after && study.date < series.studyDate;  // false for an empty date
    const bool isOfModality = series.modality.empty() || hasWord(study.modalities, "=" + series.modality);
    if (isOfPatient && isBetween && isOfModality && !isOpen) found.push_back(study);
  }
  std::ranges::stable_sort(found, std::greater(), &IndexedStudy::date);
  return found;
}

bool soundsLike(const Series& series, const IndexedStudy& study) {
  const std::vector<std::string> own =
      tellingWords(series.description + ' ' + series.studyDescription + ' ' + series.bodyPart);
  const std::vector<std::string> other = tellingWords(study.description);
  return own.empty() || other.empty() || std::ranges::find_first_of(own, other) != own.end();
}

SeriesPicture likelySecond(const Workspace& workspace, const SeriesPicture& picture,
                           const std::vector<const Series*>& open) {
  const Series& series = *picture.series;
  std::set<SeriesKey> shown;
  for (const ViewId id : viewsOnScreen(workspace)) shown.insert(workspace.view(id).series);
  const auto facts = [](const Series& s) { return std::pair(weightingOf(s), kernelOf(s)); };
  if (isKnownPatient(series) && isUsefulVolume(series) && !opensAsPictures(series)) {
    const Series* best = nullptr;
    for (const Series* other : studiesAround(open, series).current) {
      const bool fits = !shown.contains(keyOf(*other)) && other->modality == series.modality &&
                        isUsefulVolume(*other) && !areTimePoints(series, *other) &&
                        frameOfReference(*other) == frameOfReference(series) && acquiredPlaneOf(*other) &&
                        acquiredPlaneOf(*other) == acquiredPlaneOf(series) && facts(*other) != facts(series);
      if (fits && (!best || seriesNumberOf(*other) < seriesNumberOf(*best))) best = other;
    }
    if (best) return {best};
  }
  const SeriesPicture prior = priorOf(picture, open);
  return prior && !shown.contains(keyOf(*prior.series)) ? prior : SeriesPicture{};
}

Workspace withLikelySecond(Workspace workspace, const std::vector<const Series*>& open) {
  if (!comparesSeries(workspace.layout)) return workspace;
  const SeriesPicture first = firstCompared(workspace);
  if (!first) return workspace;
  const std::vector<ViewId> views = viewsInMain(workspace);
  const std::shared_ptr<const Series> over = seriesOverFirst(workspace);
  const SeriesPicture second = over ? SeriesPicture{over.get()} : likelySecond(workspace, first, open);
  const auto empty =
      std::ranges::find_if(views, [&](ViewId id) { return workspace.view(id).series.empty(); });
  if (!second || empty == views.end()) return workspace;
  workspace = withPictures(std::move(workspace), *empty, second);
  return withTimePointsOf(std::move(workspace), *second.series, open);
}

Workspace comparedWithPrior(Workspace workspace, const SeriesPicture& current, const SeriesPicture& prior) {
  const Series left = *current.series,
               right = *prior.series;  // copies: the workspace may own them
  workspace = withScrollLinked(std::move(workspace), true);
  workspace.layout = Layout::two;
  workspace.focus = firstComparedId;
  workspace = withPictures(std::move(workspace), firstComparedId, {&left, current.frame});
  workspace = withPictures(std::move(workspace), firstComparedId + 1, {&right, prior.frame});
  workspace.focus = firstComparedId;
  // The two are not compared by a window that one view had alone.
  for (const ViewId id : {firstComparedId, firstComparedId + 1})
    if (flatLookOf(workspace.view(id)).windowAlone)
      workspace = withWindowAlone(std::move(workspace), id, false);
  return workspace;
}

QString dateToTellApart(const Workspace& workspace, ViewId view) {
  const Series* own = seriesIn(workspace, view);
  if (!own) return {};
  std::set<std::string> days{own->studyDate};
  for (const ViewId id : viewsOnScreen(workspace))
    if (const Series* other = seriesIn(workspace, id)) days.insert(other->studyDate);
  if (days.size() < 2) return {};
  if (own->studyDate.empty()) return tr("(no date)");
  if (namesHidden()) return own->studyDate == *days.rbegin() ? tr("Current") : tr("Prior");
  return dateText(own->studyDate);
}

}  // namespace volumen
