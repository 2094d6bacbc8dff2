#include "ui/workspace/session.h"

#include <algorithm>
#include <iterator>

#include "results/text/series_text.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/workspace/curved_planes.h"
#include "ui/workspace/edit_workspace.h"
#include "ui/workspace/needed_series.h"
#include "viewer/scene/presets.h"

namespace volumen {

namespace {

SceneLook firstLook(const LoadedSeries& series) {
  return {series.firstScene, std::make_shared<ChosenPreset>(ChosenPreset{"auto", series.firstScene})};
}

}  // namespace

Session::Session(QObject* parent) : QObject(parent) {}

PoolKey Session::poolKeyOf(const SeriesKey& series) const { return {series, maskOf(series)}; }

LoadedSeriesPtr Session::seriesNamed(const SeriesKey& key) const {
  return key.empty() ? nullptr : pool_->peek(poolKeyOf(key));
}

LoadedSeriesPtr Session::seriesOf(ViewId view) const { return seriesNamed(workspace_.view(view).series); }

const Scene& Session::sceneOf(ViewId view) const {
  static const Scene none;
  const ViewState& shown = workspace_.view(view);
  const auto look = shown.scenes.find(shown.series);
  return look == shown.scenes.end() ? none : look->second.scene;
}

void Session::show(LoadedSeriesPtr series) {
  if (series) return show(std::move(series), workspace_.focus);
  closeAll({});
}

void Session::show(LoadedSeriesPtr series, ViewId view, const Arrange& arrange) {
  const SeriesKey key = keyOf(series->series);
  pool_->put({key, {}}, series);
  const SceneLook first = firstLook(*series);
  const bool isNew = !workspace_.series.contains(key);
  Workspace after = withSeries(workspace_, view, series->series, first);
  begin(tr("Show %1").arg(seriesText(series->series)),
        arrange ? arrange(std::move(after), isNew) : std::move(after));
}

void Session::showFrames(const Series& series, ViewId view, const Arrange& arrange) {
  const bool isNew = !workspace_.series.contains(keyOf(series));
  Workspace after = withFrames(workspace_, view, series);
  begin(tr("Show %1").arg(seriesText(series)), arrange ? arrange(std::move(after), isNew) : std::move(after));
}

void Session::showAs(ViewId view, ViewKind kind) {
  const LoadedSeriesPtr series = seriesOf(view);
  if (!series) return;
  const ViewState& scenes = workspace_.view(sceneViewOf(workspace_));
  const auto look = scenes.scenes.find(keyOf(series->series));
  endGesture();
  change(
      showsScene(kind) ? tr("Show in 3D") : tr("Show plane"),
      withKind(workspace_, view, kind,
               scenes.series == keyOf(series->series) && look != scenes.scenes.end() ? look->second
                                                                                     : firstLook(*series)));
}

// Returns whether this window has shown nothing yet.
bool Session::isFresh() const { return workspace_.series.empty() && undoStack_.count() == 0; }

// Makes an undo step, except for the first series of a window.
void Session::begin(const QString& text, Workspace after) {
  endGesture();
  if (isFresh() || after == workspace_)
    setWorkspace(after);
  else
    change(text, std::move(after), seriesShownKey);
}

void Session::makeRoom(const QString& text, const Workspace& after) {
  endGesture();
  change(text, after, roomMadeKey);
}

bool Session::showAgain(const Series& series, ViewId view, const Arrange& arrange) {
  const LoadedSeriesPtr held = pool_->find({keyOf(series), {}});
  if (held) show(held, view, arrange);
  return held != nullptr;
}

void Session::keep(LoadedSeriesPtr series, const Mask& mask) {
  pool_->put({keyOf(series->series), mask}, series);
  setWorkspace(withFound(workspace_, series->series));
}

void Session::open(const QString& text, const Workspace& workspace) {
  endGesture();
  requests_.show.reset();
  const Workspace after = replacedBy(workspace_, workspace);
  if (isFresh()) return setWorkspace(after);
  if (after != workspace_) push(text, after, {});
}

void Session::close(const std::vector<SeriesKey>& series, const std::vector<DerivedKey>& derived) {
  Workspace after = workspace_;
  std::vector<SeriesKey> gone = series;
  for (const SeriesKey& key : series)
    std::ranges::copy(unusedCurvesOf(workspace_, key), std::back_inserter(gone));
  for (const SeriesKey& key : gone)
    if (after.series.contains(key)) after = without(std::move(after), key);
  Unlisted& unlisted = after.unlisted.edit();
  unlisted.series.insert(series.begin(), series.end());
  unlisted.derived.insert(derived.begin(), derived.end());
  if (after == workspace_) return;
  endGesture();
  if (requests_.show && std::ranges::count(gone, keyOf(*requests_.show->series)) > 0) requests_.show.reset();
  for (const SeriesKey& key : gone) pool_->forget(key);
  push(tr("Remove from list"), after, {});
}

void Session::closeAll(const Unlisted& listed) {
  Workspace empty;
  empty.layout = workspace_.layout;
  empty.second = workspace_.second;
  empty.goal = workspace_.goal;
  Workspace after = replacedBy(workspace_, empty);
  Unlisted& unlisted = after.unlisted.edit();
  for (const auto& [key, state] : workspace_.series) unlisted.series.insert(key);
  unlisted.series.insert(listed.series.begin(), listed.series.end());
  unlisted.derived.insert(listed.derived.begin(), listed.derived.end());
  endGesture();
  pool_->clear();
  if (after != workspace_) push(tr("Close all"), after, {});
}

void Session::list(const std::vector<SeriesKey>& series, const std::vector<DerivedKey>& derived) {
  Workspace after = workspace_;
  Unlisted& unlisted = after.unlisted.edit();
  for (const SeriesKey& key : series) unlisted.series.erase(key);
  for (const DerivedKey& key : derived) unlisted.derived.erase(key);
  if (after != workspace_) setWorkspace(after);
}

void Session::change(const QString& text, Workspace after, const QString& mergeKey) {
  if (after == workspace_) return;
  push(text, withLinksFollowed(workspace_, std::move(after), viewSizes_), mergeKey);
}

void Session::playOn(int steps, const std::function<void()>& edit) {
  playsNow_ = true;
  playsOn_ = undoStack_.index() > steps;
  edit();
  playsOn_ = playsNow_ = false;
}

void Session::adapt(const Workspace& after) {
  if (after != workspace_) setWorkspace(after);
}

void Session::push(const QString& text, Workspace after, const QString& mergeKey) {
  const QString& key = playsOn_ ? playedOnKey : mergeKey;
  undoStack_.push(new EditWorkspace(*this, text, std::move(after), key, gesture_));
  fitUndo();
}

void Session::change(const QString& text, const std::function<void(Workspace&)>& edit,
                     const QString& mergeKey) {
  Workspace after = workspace_;
  edit(after);
  change(text, std::move(after), mergeKey);
}

void Session::edit(ViewId view, const QString& text, const std::function<void(Scene&)>& edit,
                   const QString& mergeKey) {
  const ViewState& shown = workspace_.view(view);
  if (!shown.scenes.contains(shown.series)) return;
  change(
      text, [&](Workspace& w) { edit(w.editView(view).scenes.edit(shown.series).scene); }, mergeKey);
}

void Session::edit(const QString& text, const std::function<void(Scene&)>& change, const QString& mergeKey) {
  edit(sceneViewOf(workspace_), text, change, mergeKey);
}

void Session::edit(const QString& text, Scene after, const QString& mergeKey) {
  edit(
      text, [&](Scene& scene) { scene = std::move(after); }, mergeKey);
}

void Session::setMask(const QString& text, const SeriesKey& series, const Mask& mask) {
  endGesture();
  change(text, [&](Workspace& w) { w.series.edit(series).mask = mask; });
}

Mask Session::maskOf(const SeriesKey& series) const {
  const auto known = workspace_.series.find(series);
  return known == workspace_.series.end() ? Mask{} : known->second.mask;
}

LoadedSeriesPtr Session::seriesWith(const SeriesKey& series, const Mask& mask) const {
  return pool_->peek({series, mask});
}

void Session::setGoal(const QString& text, const QualityGoal& after, const QString& mergeKey) {
  change(
      text, [&](Workspace& w) { w.goal = after; }, mergeKey);
}

void Session::choosePreset(const QString& text, const std::string& name, const Scene& look) {
  if (state_.preset && state_.preset->name == name && sameLook(state_.scene, look) && !presetModified())
    return;
  change(text, [&](Workspace& w) {
    ViewState& view = w.editView(sceneViewOf(w));
    if (!view.scenes.contains(view.series)) return;
    SceneLook& shown = view.scenes.edit(view.series);
    shown.scene = withLook(shown.scene, look);
    shown.preset = std::make_shared<ChosenPreset>(ChosenPreset{name, look});
  });
}

bool Session::presetModified() const {
  return state_.preset && !sameLook(state_.scene, state_.preset->scene);
}

void Session::setFocus(ViewId view) {
  if (view == workspace_.focus) return;
  endGesture();
  setWorkspace(withFocus(workspace_, view));
}

void Session::select(int measurement) {
  if (measurement == workspace_.selected) return;
  Workspace after = workspace_;
  after.selected = measurement;
  setWorkspace(after);
}

void Session::prefer(const Preferences& preferences) {
  if (preferences == preferences_) return;
  const Preferences before = std::exchange(preferences_, preferences);
  hideNames(preferences.hideNames);
  showPetIn(preferences.petUnit);
  pool_->setBudget(SeriesPool::partOfMemory(preferences.memoryPercent));
  Q_EMIT preferencesChanged(before, preferences_);
}

void Session::prefer(const std::function<void(Preferences&)>& change) {
  Preferences after = preferences_;
  change(after);
  prefer(after);
}

SessionState Session::stateInFocus() const {
  const ViewId id = sceneViewOf(workspace_);
  const ViewState& view = workspace_.view(id);
  const auto look = view.scenes.find(view.series);
  SessionState state{seriesOf(id), {}, workspace_.goal, nullptr};
  if (look != view.scenes.end()) state.scene = look->second.scene, state.preset = look->second.preset;
  return state;
}

void Session::request(const std::function<void(Requests&)>& change) {
  const Requests before = requests_;
  change(requests_);
  if (requests_ != before) Q_EMIT needsChanged();
}

void Session::setWorkspace(const Workspace& workspace) {
  Workspace after = workspace;  // a copy, because it may be the present one
  const Workspace before = std::exchange(workspace_, std::move(after));
  std::vector<PoolKey> onScreen = seriesOnScreen(workspace_);
  for (std::size_t n = 0, count = onScreen.size(); n < count; ++n)
    onScreen.push_back({onScreen[n].series, {}});  // unmasked, for the next mask
  pool_->setOnScreen(std::move(onScreen));
  const SessionState stateBefore = std::exchange(state_, stateInFocus());
  Q_EMIT workspaceChanged(before, workspace_);
  if (stateBefore != state_) Q_EMIT changed(stateBefore, state_);
  Q_EMIT needsChanged();
}

}  // namespace volumen
