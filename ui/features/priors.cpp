#include "ui/workspace/priors.h"

#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/links.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

// The series in focus beside the same one of an earlier day.
class Priors : public Feature {
 public:
  explicit Priors(Workbench& bench);

 private:
  void compare();
  void offerRegistration(const Series& current, const Series& prior);
};

Priors::Priors(Workbench& bench) : Feature(bench) {
  bench_.addAction({"comparePrior",
                    tr("Compare with prior"),
                    {tr("Alt+7")},
                    "",
                    false,
                    [this](bool) { compare(); },
                    {{"viewMenu", 60, 54}}});
}

void Priors::compare() {
  const Workspace& workspace = session_.workspace();
  const SeriesPicture shown = pictureIn(workspace, workspace.focus);
  if (!shown) return warn(tr("Click a view that shows a series first."));
  const SeriesPicture found = priorOf(shown, open_.pictures());
  if (!found)
    return warn(
        tr("No earlier study of this patient with such a series is open: open one first, from the "
           "list of studies (Ctrl+B) or from its folder (Ctrl+O)."));
  const Series current = *shown.series, prior = *found.series;
  session_.endGesture();
  session_.setFocus(mainFocusOf(workspace));
  bench_.action("maximise")->setChecked(false);
  session_.change(tr("Compare with prior"),
                  withTimePointsOf(comparedWithPrior(workspace, shown, found), prior, open_.volumes()));
  session_.endGesture();
  offerRegistration(current, prior);
}

// Positions of two days are comparable only where they are in one frame of reference.
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
