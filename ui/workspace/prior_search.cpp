#include "ui/workspace/prior_search.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "results/text/text.h"

namespace volumen {

namespace {

using Stage = PriorSearch::Stage;

constexpr int mostOpened = 3;  // opened automatically, one after the other

bool isOnScreen(const Workspace& workspace, const Series& series) {
  return std::ranges::any_of(viewsOnScreen(workspace), [&](ViewId id) {
    const Series* shown = seriesIn(workspace, id);
    return shown && keyOf(*shown) == keyOf(series);
  });
}

bool isWithCandidate(const PriorSearch& search) { return search.stage != Stage::none; }

QString awayText() {
  return tr(
      "The files of an earlier study of this patient are not there now: connect the disk or network "
      "folder that holds them, or import the folder from where they are.");
}

QString laterText(const std::string& day) {
  return namesHidden()
             ? tr("The list of studies holds a later prior: Alt+7 again opens it.")
             : tr("The list of studies holds a later prior, of %1: Alt+7 again opens it.").arg(dateText(day));
}

// Returns the end of a search that has nothing more to open, with the reason.
PriorStep withNone(const PriorSearch& search) {
  if (search.isAway) return {.warned = awayText()};
  if (!search.candidates.empty())
    return {.warned = tr("The %1 earlier studies of this patient that were looked into hold no such series: "
                         "open another one from the list of studies (Ctrl+B).")
                          .arg(search.opened)};
  if (search.isUnread)
    return {.warned = search.after.empty()
                          ? tr("A list of studies could not be read: it may hold an earlier study of this "
                               "patient. Open one from its folder (Ctrl+O).")
                          : tr("A list of studies could not be read: it may hold a later prior of this "
                               "patient.")};
  if (search.after.empty())
    return {.warned = tr("No earlier study of this patient with such a series is open or in the list of "
                         "studies: open one from its folder (Ctrl+O), or import it (Ctrl+I).")};
  if (search.opened > 0) return {.told = tr("The later study of this patient holds no such series.")};
  return {};
}

// Keeps one copy of each study: one that is not offline, from the first source. Archives come after this
// computer.
void keepOneOfEach(std::deque<PriorCandidate>& candidates) {
  std::ranges::stable_sort(
      candidates, {}, [](const PriorCandidate& each) { return std::pair(each.study.offline, each.source); });
  std::set<std::string> known;
  std::erase_if(candidates, [&](const PriorCandidate& each) {
    return !each.study.studyUid.empty() && !known.insert(each.study.studyUid).second;
  });
}

PriorStep withNextOpened(PriorSearch search) {
  while (!search.candidates.empty() && search.opened < mostOpened) {
    search.candidate = search.candidates.front();
    search.candidates.pop_front();
    search.isAway = search.isAway || search.candidate.study.offline;
    if (search.candidate.study.offline) continue;
    search.stage = Stage::opening;
    ++search.opened;
    return {.search = std::move(search),
            .told = tr("Opening an earlier study of this patient from the list of studies."),
            .opensCandidate = true};
  }
  return withNone(search);
}

// Returns what the user should know of a prior that was shown. Similar descriptions came first, so a later
// study may have been skipped.
QString reservationText(const PriorSearch& search, const std::string& shownDay) {
  if (search.isAway) return awayText();
  const auto isLater = [&](const PriorCandidate& each) { return each.study.date > shownDay; };
  if (std::ranges::none_of(search.candidates, isLater)) return {};
  return tr(
      "A later study of this patient was not looked into, as its description names something else: it "
      "can be opened from the list of studies (Ctrl+B).");
}

}  // namespace

PriorStep begunSearch(const Workspace& workspace, const SeriesPicture& picture,
                      const std::vector<const Series*>& open, const std::set<int>& sources) {
  PriorStep step{.search = {.series = *picture.series, .frame = picture.frame},
                 .shown = priorOf(picture, open)};
  PriorSearch& search = step.search;
  if (step.shown) {
    search.after = step.shown.series->studyDate;
    search.mayOpen = isOnScreen(workspace, *step.shown.series);
  }
  if (!search.series.patientId.empty()) {
    search.asked = sources;
  } else if (!step.shown) {
    step.warned =
        tr("No earlier study of this patient is open, and without a patient ID none is opened from the list "
           "of studies: open one there (Ctrl+B), or from its folder (Ctrl+O).");
  }
  return step;
}

PriorStep withAnswer(PriorSearch search, const Workspace& workspace, const std::vector<const Series*>& open,
                     const PriorAnswer& answer) {
  // The answer may belong to another request, so the patient is compared.
  const Series& series = search.series;
  const bool isOfPatient = series.patientId == answer.patientId && series.patientName == answer.patientName;
  if (!isOfPatient || !search.asked.erase(answer.source)) return {search};
  if (!isOnScreen(workspace, series)) return {};
  search.isUnread = search.isUnread || !answer.studies;
  for (const IndexedStudy& study :
       unopenedPriors(series, answer.studies.value_or(std::vector<IndexedStudy>()), open, search.after))
    search.candidates.push_back({answer.source, study});
  if (!search.asked.empty()) return {search};
  keepOneOfEach(search.candidates);
  std::ranges::stable_sort(search.candidates, std::greater(), [&](const PriorCandidate& each) {
    return std::pair(soundsLike(series, each.study), each.study.date);
  });
  if (!search.mayOpen && !search.candidates.empty())
    return {.told = laterText(search.candidates.front().study.date)};
  return withNextOpened(std::move(search));
}

PriorSearch withFilesFound(PriorSearch search, bool areOpenedByUser) {
  if (isWithCandidate(search)) search.stage = areOpenedByUser ? Stage::none : Stage::reading;
  return search;
}

PriorStep withoutFiles(PriorSearch search) {
  if (!isWithCandidate(search)) return {search};
  search.isAway = true;
  return withNextOpened(std::move(search));
}

PriorStep withStudyRead(PriorSearch search, const Workspace& workspace,
                        const std::vector<const Series*>& series) {
  if (!isWithCandidate(search)) return {search};
  if (!isOnScreen(workspace, search.series)) return {};
  const std::vector<const Series*> earlier = earlierOf(search.series, series, search.after);
  search.isAway = search.isAway || earlier.empty();
  const SeriesPicture found = mostLike({&search.series, search.frame}, earlier);
  if (!found) return withNextOpened(std::move(search));
  search.stage = Stage::none;
  const QString reservation = reservationText(search, found.series->studyDate);
  return {.search = std::move(search), .shown = found, .warned = reservation};
}

PriorSearch withReadingOver(PriorSearch search) {
  if (search.stage == Stage::reading) search.stage = Stage::none;
  return search;
}

}  // namespace volumen
