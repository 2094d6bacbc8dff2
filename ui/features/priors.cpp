#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/links.h"
#include "ui/workspace/prior_search.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

// Compares the series in focus with the same one of an earlier day. Takes it from an open study, or opens a
// study that a source lists.
class Priors : public Feature {
 public:
  explicit Priors(Workbench& bench);

 private:
  void connectSource(std::size_t number);
  void compare();
  void carryOut(const PriorStep& step);
  void show(const SeriesPicture& current, const SeriesPicture& prior);
  bool isCandidate(const QString& place) const;
  void lookInto(const QString& place, const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void offerRegistration(const Series& current, const Series& prior);

  std::set<int> offeredSources() const;

  const StudySourceList& sources_ = bench_.document.sources.all();
  PriorSearch search_;
};

Priors::Priors(Workbench& bench) : Feature(bench) {
  bench_.addAction({"comparePrior",
                    tr("Compare with prior"),
                    {tr("Alt+7")},
                    "",
                    false,
                    [this](bool) { compare(); },
                    {{"viewMenu", 60, 54}}});
  for (std::size_t n = 0; n < sources_.size(); ++n) connectSource(n);
  connect(&bench_.document.sources, &StudySources::added, this, &Priors::connectSource);
  connect(&bench_.document.loader, &Loader::filesOpened, this, &Priors::lookInto);
  connect(&bench_.document.loader, &Loader::idle, this,
          [this] { search_ = withReadingOver(std::move(search_)); });
}

void Priors::connectSource(std::size_t number) {
  const StudySource* source = sources_[number].get();
  connect(source, &StudySource::patientListed, this,
          [this, number](const std::string& id, const std::string& name,
                         const std::optional<std::vector<IndexedStudy>>& studies) {
            carryOut(withAnswer(search_, session_.workspace(), open_.pictures(),
                                {int(number), id, name, studies}));
          });
  connect(
      source, &StudySource::filesFound, this,
      [this, source](const IndexedChoice& choice, const std::vector<std::string>&, const OpenIntent& intent) {
        if (isCandidate(source->placeOf(choice.study)))
          search_ = withFilesFound(search_, intent.how != OpenHow::lookedInto);
      });
  connect(source, &StudySource::notOpened, this, [this, source](const IndexedChoice& choice) {
    if (isCandidate(source->placeOf(choice.study))) carryOut(withoutFiles(search_));
  });
}

void Priors::compare() {
  const SeriesPicture shown = pictureIn(session_.workspace(), session_.workspace().focus);
  if (!shown) return warn(tr("Click a view that shows a series first."));
  carryOut(begunSearch(session_.workspace(), shown, open_.pictures(), offeredSources()));
  if (search_.asked.empty()) return;
  const Series series = search_.series;  // a copy, as an answer may come at once
  for (const int n : std::set(search_.asked))
    sources_[std::size_t(n)]->studiesOf(series.patientId, series.patientName);
}

std::set<int> Priors::offeredSources() const {
  std::set<int> numbers;
  for (std::size_t n = 0; n < sources_.size(); ++n)
    if (std::ranges::count(bench_.document.sources.offered(), sources_[n].get())) numbers.insert(int(n));
  return numbers;
}

void Priors::carryOut(const PriorStep& step) {
  search_ = step.search;
  if (step.shown) show({&step.search.series, step.search.frame}, step.shown);
  if (!step.told.isEmpty()) tell(step.told);
  if (!step.warned.isEmpty()) warn(step.warned);
  if (!step.opensCandidate) return;
  const PriorCandidate& candidate = step.search.candidate;
  sources_[std::size_t(candidate.source)]->open({candidate.study.id, 0}, OpenHow::lookedInto);
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

// Returns whether this is the study that the search opened last.
bool Priors::isCandidate(const QString& place) const {
  const PriorCandidate& candidate = search_.candidate;
  return place == sources_[std::size_t(candidate.source)]->placeOf(candidate.study.id);
}

void Priors::lookInto(const QString& place, const std::shared_ptr<const Study>& study,
                      const OpenIntent& intent) {
  if (intent.how != OpenHow::lookedInto || !isCandidate(place)) return;
  const std::vector<Series> frames = frameSeries(*study);
  std::vector<const Series*> pictures;
  for (const std::vector<Series>* all : {&study->volumes, &frames})
    for (const Series& each : *all) pictures.push_back(&each);
  const PriorStep step = withStudyRead(search_, session_.workspace(), pictures);
  if (step.shown) bench_.document.opener.list(place, study);
  if (step.shown && !study->refused.empty())
    bench_.banner.add(unreadText(*study), refusedTexts(study->refused));
  carryOut(step);
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
