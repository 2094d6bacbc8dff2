#include "ui/workspace/priors.h"

#include <deque>
#include <tuple>
#include <utility>

#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/links.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

constexpr int mostOpened = 3;  // opened automatically, one after the other

// Compares the series in focus with the same one of an earlier day. Takes it from an open study, or opens a
// study that a source lists.
class Priors : public Feature {
 public:
  explicit Priors(Workbench& bench);

 private:
  struct Listed {
    StudySource* source;
    IndexedStudy study;
    bool soundsLike;
  };
  // A picture whose prior is wanted.
  struct Wanted {
    SeriesKey series;
    int frame = -1;
    std::string after{};           // day of the open prior, empty if none
    bool mayOpen = true;           // if false, only reports that a later prior exists
    int answers = 0;               // pending answers of sources
    std::deque<Listed> studies{};  // candidates: similar descriptions first, then latest first
    bool isUnread = false;         // a source could not be asked
    bool isAway = false;           // files of a candidate are missing or have changed
    int opened = 0;                // number of candidates opened
    QString place{};               // place of the candidate being opened, empty before the first
    bool isRead = false;           // its files were found and are being read
  };

  void compare();
  void show(const SeriesPicture& current, const SeriesPicture& prior);
  void askSources(const Series& series);
  void take(StudySource& source, const std::string& patientId, const std::string& patientName,
            const std::optional<std::vector<IndexedStudy>>& studies);
  void openNext();
  void lookInto(const QString& place, const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void list(const QString& place, const std::shared_ptr<const Study>& study);
  SeriesPicture current() const;
  void tellNone(const Wanted& wanted);
  void tellAway();
  void tellLater(const Wanted& wanted);
  void tellPassedOver(const Wanted& wanted, const std::string& shownDay);
  void offerRegistration(const Series& current, const Series& prior);

  std::optional<Wanted> wanted_;
};

Priors::Priors(Workbench& bench) : Feature(bench) {
  bench_.addAction({"comparePrior",
                    tr("Compare with prior"),
                    {tr("Alt+7")},
                    "",
                    false,
                    [this](bool) { compare(); },
                    {{"viewMenu", 60, 54}}});
  for (const auto& each : bench_.document.sources.all()) {
    StudySource* source = each.get();
    connect(source, &StudySource::patientListed, this,
            [this, source](const std::string& id, const std::string& name,
                           const std::optional<std::vector<IndexedStudy>>& studies) {
              take(*source, id, name, studies);
            });
    connect(source, &StudySource::filesFound, this,
            [this, source](const IndexedChoice& choice, const std::vector<std::string>&,
                           const OpenIntent& intent) {
              if (!wanted_ || wanted_->place != source->placeOf(choice.study)) return;
              if (intent.how != OpenHow::lookedInto) return wanted_.reset();  // the user opened it
              wanted_->isRead = true;
            });
    connect(source, &StudySource::notOpened, this, [this, source](const IndexedChoice& choice) {
      if (!wanted_ || wanted_->place != source->placeOf(choice.study)) return;
      wanted_->isAway = true;
      openNext();
    });
  }
  connect(&bench_.document.loader, &Loader::filesOpened, this, &Priors::lookInto);
  // The load was cancelled or failed.
  connect(&bench_.document.loader, &Loader::idle, this, [this] {
    if (wanted_ && wanted_->isRead) wanted_.reset();
  });
}

// Shows an open prior at once. If that is already shown, opens a later one from the lists.
void Priors::compare() {
  const Workspace& workspace = session_.workspace();
  const SeriesPicture shown = pictureIn(workspace, workspace.focus);
  if (!shown) return warn(tr("Click a view that shows a series first."));
  const Series series = *shown.series;
  wanted_ = Wanted{keyOf(series), shown.frame};
  if (const SeriesPicture found = priorOf(shown, open_.pictures())) {
    wanted_->after = found.series->studyDate;
    wanted_->mayOpen = std::ranges::any_of(viewsOnScreen(workspace), [&](ViewId id) {
      return workspace.view(id).series == keyOf(*found.series);
    });
    show(shown, found);
  }
  if (!series.patientId.empty()) return askSources(series);
  if (wanted_->after.empty())
    warn(
        tr("No earlier study of this patient is open, and without a patient ID none is opened from the list "
           "of studies: open one there (Ctrl+B), or from its folder (Ctrl+O)."));
  wanted_.reset();
}

void Priors::show(const SeriesPicture& current, const SeriesPicture& prior) {
  const Series left = *current.series, right = *prior.series;
  takeBack();
  session_.endGesture();
  session_.setFocus(mainFocusOf(session_.workspace()));
  grid_.setAlone(sceneViewId, false);
  session_.change(
      tr("Compare with prior"),
      withTimePointsOf(comparedWithPrior(session_.workspace(), current, prior), right, open_.volumes()));
  session_.endGesture();
  offerRegistration(left, right);
}

void Priors::askSources(const Series& series) {
  const auto& sources = bench_.document.sources.all();
  wanted_->answers = int(sources.size());
  for (const auto& source : sources) source->studiesOf(series.patientId, series.patientName);
}

// Answers may belong to another request, so the patient is compared.
void Priors::take(StudySource& source, const std::string& patientId, const std::string& patientName,
                  const std::optional<std::vector<IndexedStudy>>& studies) {
  const SeriesPicture now = current();
  if (!now || !wanted_->answers) return;
  if (now.series->patientId != patientId || now.series->patientName != patientName) return;
  wanted_->isUnread = wanted_->isUnread || !studies;
  for (const IndexedStudy& study : unopenedPriors(*now.series, studies.value_or(std::vector<IndexedStudy>()),
                                                  open_.pictures(), wanted_->after))
    wanted_->studies.push_back({&source, study, soundsLike(*now.series, study)});
  if (--wanted_->answers > 0) return;
  std::ranges::stable_sort(wanted_->studies, [](const Listed& a, const Listed& b) {
    return std::tie(b.soundsLike, b.study.date) < std::tie(a.soundsLike, a.study.date);
  });
  if (wanted_->mayOpen) return openNext();
  if (!wanted_->studies.empty()) return tellLater(*std::exchange(wanted_, {}));
  const Wanted all = *std::exchange(wanted_, {});
  if (all.isUnread) tellNone(all);
}

void Priors::openNext() {
  while (!wanted_->studies.empty() && wanted_->opened < mostOpened) {
    const Listed next = wanted_->studies.front();
    wanted_->studies.pop_front();
    wanted_->isAway = wanted_->isAway || next.study.offline;
    if (next.study.offline) continue;
    wanted_->place = next.source->placeOf(next.study.id);
    wanted_->isRead = false;
    ++wanted_->opened;
    tell(tr("Opening an earlier study of this patient from the list of studies."));
    return next.source->open({next.study.id, 0}, OpenHow::lookedInto);
  }
  tellNone(*std::exchange(wanted_, {}));
}

// Checks the files, as they may differ from the list and even belong to another patient.
void Priors::lookInto(const QString& place, const std::shared_ptr<const Study>& study,
                      const OpenIntent& intent) {
  if (!wanted_ || intent.how != OpenHow::lookedInto || wanted_->place != place) return;
  const SeriesPicture now = current();
  if (!now) return wanted_.reset();
  const Series series = *now.series;  // a copy, as the workspace changes
  const std::vector<Series> frames = frameSeries(*study);
  std::vector<const Series*> pictures;
  for (const std::vector<Series>* all : {&study->volumes, &frames})
    for (const Series& each : *all) pictures.push_back(&each);
  const std::vector<const Series*> earlier = earlierOf(series, pictures, wanted_->after);
  wanted_->isAway = wanted_->isAway || earlier.empty();
  const SeriesPicture found = mostLike({&series, now.frame}, earlier);
  if (!found) return openNext();
  const Wanted all = *std::exchange(wanted_, {});
  list(place, study);
  show({&series, now.frame}, found);
  if (all.isAway) return tellAway();
  tellPassedOver(all, found.series->studyDate);
}

void Priors::list(const QString& place, const std::shared_ptr<const Study>& study) {
  bench_.document.opener.list(place, study);
  if (!study->refused.empty()) bench_.banner.add(unreadText(*study), refusedTexts(study->refused));
}

// Returns the picture whose prior is wanted, or nothing if it is no longer on screen.
SeriesPicture Priors::current() const {
  if (!wanted_) return {};
  const Workspace& workspace = session_.workspace();
  for (const ViewId id : viewsOnScreen(workspace))
    if (const Series* series = seriesIn(workspace, id); series && keyOf(*series) == wanted_->series)
      return {series, wanted_->frame};
  return {};
}

void Priors::tellNone(const Wanted& wanted) {
  if (wanted.isAway) return tellAway();
  if (!wanted.studies.empty())
    return warn(
        tr("The %1 earlier studies of this patient that were looked into hold no such series: open another "
           "one from the list of studies (Ctrl+B).")
            .arg(wanted.opened));
  if (wanted.isUnread)
    return warn(
        wanted.after.empty()
            ? tr("The list of studies could not be read: it may hold an earlier study of this patient. Open "
                 "one from its folder (Ctrl+O).")
            : tr("The list of studies could not be read: it may hold a later prior of this patient."));
  if (wanted.after.empty())
    return warn(
        tr("No earlier study of this patient with such a series is open or in the list of studies: open one "
           "from its folder (Ctrl+O), or import it (Ctrl+I)."));
  if (wanted.opened > 0) tell(tr("The later study of this patient holds no such series."));
}

void Priors::tellAway() {
  warn(
      tr("The files of an earlier study of this patient are not there now: connect the disk or network "
         "folder that holds them, or import the folder from where they are."));
}

void Priors::tellLater(const Wanted& wanted) {
  tell(namesHidden() ? tr("The list of studies holds a later prior: Alt+7 again opens it.")
                     : tr("The list of studies holds a later prior, of %1: Alt+7 again opens it.")
                           .arg(dateText(wanted.studies.front().study.date)));
}

// Similar descriptions came first, so a later study may have been skipped.
void Priors::tellPassedOver(const Wanted& wanted, const std::string& shownDay) {
  if (std::ranges::any_of(wanted.studies, [&](const Listed& each) { return each.study.date > shownDay; }))
    warn(
        tr("A later study of this patient was not looked into, as its description names something else: it "
           "can be opened from the list of studies (Ctrl+B)."));
}

// Positions of two days are comparable only in one frame of reference.
void Priors::offerRegistration(const Series& current, const Series& prior) {
  const Workspace& workspace = session_.workspace();
  const bool areSlices = current.acquired.calibrated && prior.acquired.calibrated &&
                         !showsFrames(workspace.view(firstComparedId).kind);
  if (areSlices && !relationOf(workspace, frameOfReference(current), frameOfReference(prior)))
    tell(
        tr("The prior lies elsewhere: View > Link > Register in the background makes both scroll together, "
           "or Lock here by hand."));
}

}  // namespace

std::unique_ptr<Feature> makePriors(Workbench& bench) { return std::make_unique<Priors>(bench); }

}  // namespace volumen
