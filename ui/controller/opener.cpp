#include "ui/controller/opener.h"

#include <QSettings>
#include <algorithm>
#include <iterator>
#include <utility>

#include "io/study/choose.h"
#include "io/study/frame_series.h"
#include "results/series/time_points.h"
#include "results/text/text.h"
#include "ui/controller/find_saved.h"
#include "ui/data/study_list.h"
#include "ui/workspace/first_series.h"
#include "ui/workspace/priors.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

// Returns the settings key of the layout chosen for a modality.
QString layoutKey(const Series& series) {
  const QString modality = QString::fromStdString(series.modality);
  return QStringLiteral("layouts/") + (modality.isEmpty() ? QStringLiteral("other") : modality);
}

// Returns all items of a study that could be listed.
Unlisted everythingOf(const Study& study) {
  Unlisted all;
  for (const Series& series : allSeriesOf(study)) all.series.insert(keyOf(series));
  for (const DerivedObject& object : study.derived) all.derived.insert(keyOf(object));
  return all;
}

}  // namespace

Opener::Opener(Session& session, Loader& loader, OpenStudies& open)
    : session_(session), loader_(loader), open_(open) {
  connect(&loader_, &Loader::requestLoaded, this,
          [this](const LoadedSeriesPtr& series, const std::optional<Scene>& scene) {
            session_.show(series, session_.workspace().focus, arrangedFor(series->series));
            if (scene) session_.edit(tr("Open scene"), *scene);
          });
  connect(&loader_, &Loader::idle, this, [this] { session_.request([](Requests& r) { r.layout.reset(); }); });
}

void Opener::list(const QString& path, const std::shared_ptr<const Study>& study) {
  listBut({}, path, study);
}

void Opener::join(const QString& path, const std::shared_ptr<const Study>& study) {
  const std::shared_ptr<const Study> before = open_.studyOf(path);
  if (before) listBut(everythingOf(*before), path, study);
}

void Opener::listBut(const Unlisted& known, const QString& path, const std::shared_ptr<const Study>& study) {
  std::vector<SeriesKey> series;
  std::vector<DerivedKey> derived;
  const Unlisted all = everythingOf(*study);
  std::ranges::set_difference(all.series, known.series, std::back_inserter(series));
  std::ranges::set_difference(all.derived, known.derived, std::back_inserter(derived));
  session_.list(series, derived);
  open_.add(path, study);
}

void Opener::show(const Series& series) {
  if (opensAsPictures(series)) return showFrames(series);
  const Workspace& workspace = session_.workspace();
  const Series* shown = seriesIn(workspace, workspace.focus);
  if (shown && !showsFrames(workspace, workspace.focus) && keyOf(*shown) != keyOf(series) &&
      workspace.series.contains(keyOf(series)) && areTimePoints(*shown, series)) {
    session_.endGesture();
    return session_.change(tr("Time point"), withTimePoint(workspace, workspace.focus, keyOf(series)));
  }
  if (!session_.pool().find({keyOf(series), {}})) return read(series);
  session_.request([](Requests& r) { r.show.reset(); });  // which would replace it
  session_.showAgain(series, session_.workspace().focus, arrangedFor(series));
}

// Without a scene, keeps the one of an earlier request for this series.
void Opener::read(const Series& series, const std::optional<Scene>& scene) {
  session_.request([&](Requests& r) {
    const std::optional<Scene> before = r.shows(keyOf(series)) ? r.show->scene : std::nullopt;
    r.show = {std::make_shared<const Series>(series), scene ? scene : before};
  });
}

void Opener::showFrames(const Series& series) {
  session_.request([](Requests& r) { r.show.reset(); });
  session_.showFrames(series, session_.workspace().focus, [&](Workspace w, bool isNew) {
    return isNew ? withTimePointsOf(std::move(w), series, open_.volumes()) : std::move(w);
  });
}

std::optional<Series> Opener::firstOf(const Study& study, const std::string& seriesUid) const {
  return firstSeries(session_.workspace(), study, open_.volumes(), seriesUid);
}

void Opener::showFirst(const Study& study, const std::optional<Scene>& scene) {
  if (const auto largest = chooseSeries(study, {}); scene && largest)
    return read(study.volumes[*largest], scene);
  const std::optional<Series> first = firstOf(study);
  if (!first) return;
  return opensAsPictures(*first) ? showFrames(*first) : read(*first);
}

void Opener::showFused(const Study& study) {
  const Workspace& workspace = session_.workspace();
  if (workspace.focus >= firstComparedId) return;
  const std::optional<Requests::Show>& asked = session_.requests().show;
  const SeriesKey key = asked ? keyOf(*asked->series) : workspace.view(sceneViewId).series;
  const ViewState& planes = workspace.view(axialViewId);
  const bool isShown = planes.series == key && !showsFrames(planes.kind);
  if (isShown && !flatLookOf(planes).overlay.empty()) return;
  const std::vector<const Series*> open = open_.volumes();
  const auto first = std::ranges::find_if(open, [&](const Series* s) { return keyOf(*s) == key; });
  if (first == open.end()) return;
  if (const Series* pet = petOver(workspace, **first, study, open)) return read(*pet);
  // A PET that is still loading will be fused when it arrives.
  const Series* ct =
      (*first)->modality == "PT" && isShown && !asked ? ctUnder(workspace, **first, open) : nullptr;
  const auto isCt = [&](const Series& s) { return keyOf(s) == keyOf(*ct); };
  if (!ct || std::ranges::none_of(study.volumes, isCt)) return;
  session_.endGesture();
  session_.change(tr("Show %1").arg(seriesText(*ct)), fusedWith(workspace, *ct));
}

void Opener::chooseLayout(Layout layout) {
  const Workspace& workspace = session_.workspace();
  if (isInSecond(workspace.focus)) return session_.change(tr("Layout"), withSecondLayout(workspace, layout));
  if (loader_.isOpening()) session_.request([&](Requests& r) { r.layout = layout; });
  // Fused views count as the series on top, which is the one opened.
  const SeriesKey over = flatLookOf(workspace.view(workspace.focus)).overlay;
  const Series* shown = seriesIn(workspace, workspace.focus);
  if (const auto top = workspace.series.find(over); !over.empty() && top != workspace.series.end())
    shown = top->second.series.get();
  if (!shown && session_.requests().layout) return;
  if (shown) layoutsChosen_[layoutKey(*shown)] = layout;
  session_.change(tr("Layout"), withLikelySecond(withLayout(workspace, layout), open_.pictures()));
}

std::optional<Layout> Opener::layoutChosenFor(const Series& series) const {
  const auto chosen = layoutsChosen_.find(layoutKey(series));
  if (chosen != layoutsChosen_.end()) return chosen->second;
  return layoutNamed(QSettings().value(layoutKey(series)).toString().toStdString());
}

// Returns a grid with the series in focus first and the most likely companions beside it.
Workspace Opener::compared(Workspace workspace, Layout layout) const {
  Workspace grid = workspace;
  grid.layout = layout;
  for (const ViewId id : viewsInMain(grid)) workspace.editView(id).series = {};
  return withLikelySecond(withLayout(std::move(workspace), layout), open_.pictures());
}

// With `mayBeEmpty` comparison views may stay empty.
Workspace Opener::inLayoutOf(Workspace workspace, const Series& series, bool mayBeEmpty) const {
  if (isInSecond(workspace.focus)) return workspace;
  const std::optional<Layout> layout = layoutChosenFor(series);
  if (!layout || !isUsefulVolume(series)) return withUsualLayout(std::move(workspace), series);
  if (*layout == workspace.layout) return workspace;
  if (!comparesSeries(*layout)) return withLayout(std::move(workspace), *layout);
  Workspace grid = compared(workspace, *layout);
  const auto isEmpty = [&](ViewId id) { return grid.view(id).series.empty(); };
  const bool isFull = std::ranges::none_of(viewsInMain(grid), isEmpty);
  return isFull || mayBeEmpty ? std::move(grid) : withUsualLayout(std::move(workspace), series);
}

Workspace Opener::arranged(Workspace workspace, const Series& series, bool isNew, bool isLayoutWanted) const {
  // Fuses first, so that a grid shows the fusion too.
  const Series* ct = isNew && series.modality == "PT" && workspace.focus < firstComparedId
                         ? ctUnder(session_.workspace(), series, open_.volumes())
                         : nullptr;
  if (ct) workspace = fusedWith(std::move(workspace), *ct);
  if (!comparesSeries(workspace.layout)) workspace = inLayoutOf(std::move(workspace), series, isLayoutWanted);
  if (!isNew) return workspace;
  workspace = withSlicesInFocus(std::move(workspace));
  return withTimePointsOf(std::move(workspace), series, open_.volumes());
}

// Returns the arrangement for a series: the layout of its modality, unless series are being compared. A
// series shown for the first time also gets its time points, and a PET its CT. A layout chosen while the
// series was loading becomes the layout of its modality.
Session::Arrange Opener::arrangedFor(const Series& series) {
  const bool isLayoutWanted = session_.requests().layout.has_value();
  if (isLayoutWanted) layoutsChosen_[layoutKey(series)] = *session_.requests().layout;
  session_.request([](Requests& r) { r.layout.reset(); });
  return [this, series, isLayoutWanted](Workspace w, bool isNew) {
    return arranged(std::move(w), series, isNew, isLayoutWanted);
  };
}

void Opener::keepLayouts() const {
  QSettings settings;
  for (const auto& [key, layout] : layoutsChosen_) settings.setValue(key, QLatin1String(layoutName(layout)));
}

}  // namespace volumen
