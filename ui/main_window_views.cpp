#include <QActionGroup>
#include <QDockWidget>
#include <QSettings>
#include <QStackedWidget>
#include <algorithm>

#include "ui/data/frame_series.h"
#include "ui/main_window.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/studies_panel.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

// Where the layout that was chosen for a modality is kept.
QString layoutKey(const Series& series) {
  const QString modality = QString::fromStdString(series.modality);
  return QStringLiteral("layouts/") + (modality.isEmpty() ? QStringLiteral("other") : modality);
}

}  // namespace

void MainWindow::makeLayoutActions() {
  const std::tuple<Layout, const char*, QString, QString> table[] = {
      {Layout::one, "layoutOne", tr("One view"), tr("Alt+1")},
      {Layout::planes, "layoutPlanes", tr("Planes and 3D"), tr("Alt+2")},
      {Layout::besidePlanes, "layoutBesidePlanes", tr("Large 3D beside planes"), tr("Alt+3")},
      {Layout::two, "layoutTwo", tr("Two series"), tr("Alt+4")},
      {Layout::four, "layoutFour", tr("Four series"), tr("Alt+5")}};
  auto* group = new QActionGroup(this);
  for (const auto& [layout, name, text, key] : table) {
    auto* action = group->addAction(text);
    action->setObjectName(QLatin1String(name));
    action->setShortcut(key);
    action->setCheckable(true);
    action->setChecked(layout == session_.workspace().layout);
    connect(action, &QAction::triggered, this, [this, layout = layout] {
      if (const ShownSeriesPtr shown = session_.seriesOf(session_.workspace().focus))
        layoutsChosen_[layoutKey(shown->series)] = layout;
      session_.change(tr("Layout"), withLayout(session_.workspace(), layout));
    });
    connect(&session_, &Session::workspaceChanged, action,
            [action, layout = layout](const Workspace&, const Workspace& after) {
              action->setChecked(after.layout == layout);
            });
    addAction(action);
    actions_[action->objectName()] = action;
  }
  using Turned = Crosshair (*)(glm::dvec3, const VoxelGeometry&);
  const Turned alongPatient = [](glm::dvec3 at, const VoxelGeometry&) {
    Crosshair straight{at};
    straight.byHand = true;
    return straight;
  };
  const std::tuple<const char*, QString, Turned> turns[] = {
      {"alignPlanes", tr("Planes along the slices"), alongSlices},
      {"straightenPlanes", tr("Planes along the patient"), alongPatient}};
  for (const auto& [name, text, turned] : turns) {
    auto* action = new QAction(text, this);
    action->setObjectName(QLatin1String(name));
    connect(action, &QAction::triggered, this, [this, text = text, turned = turned] {
      const ViewId focus = session_.workspace().focus;
      const ShownSeriesPtr shown = session_.seriesOf(focus);
      if (!shown) return banner_->tell(tr("Open a series first."));
      const glm::dvec3 at = crosshairOf(session_.workspace(), focus, *shown).at;
      setCrosshair(session_, focus, *shown, text, turned(at, shown->volume->geometry()));
      session_.endGesture();
    });
    actions_[action->objectName()] = action;
  }
}

void MainWindow::connectViews() {
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (showsOther(before, after)) choosePage();
          });
  connect(docks_.at(QStringLiteral("clip")), &QDockWidget::visibilityChanged, grid_, &ViewGrid::setClipShown);
  connect(grid_, &ViewGrid::hovered, status_, &StatusLine::showHover);
  connect(grid_, &ViewGrid::maximiseRequested, this,
          [this] { actions_[QStringLiteral("maximise")]->toggle(); });
  connect(&slices_, &SliceService::failed, this,
          [this](int, const QString& sentence) { banner_->tell(sentence); });
}

// The CT that a PET is read over: of its study and frame of reference, the one with most voxels.
const Series* MainWindow::ctUnder(const Series& pet) const {
  const auto voxels = [](const Series& s) {
    return std::int64_t(s.acquired.size.x) * s.acquired.size.y * s.acquired.size.z;
  };
  const Series* found = nullptr;
  for (const Series* series : open_.volumes())
    if (series->modality == "CT" && series->studyUid == pet.studyUid &&
        whyNotOverlaid(session_.workspace(), *series, pet).isEmpty() &&
        (!found || voxels(*series) > voxels(*found)))
      found = series;
  return found;
}

// The one that was chosen last for its modality, else the usual one.
Workspace MainWindow::inLayoutOf(Workspace workspace, const Series& series) const {
  const auto chosen = layoutsChosen_.find(layoutKey(series));
  const QString kept = QSettings().value(layoutKey(series)).toString();
  const auto layout =
      chosen == layoutsChosen_.end() ? layoutNamed(kept.toStdString()) : std::optional(chosen->second);
  if (!layout || !isUsefulVolume(series)) return withUsualLayout(std::move(workspace), series);
  return *layout == workspace.layout ? workspace : withLayout(std::move(workspace), *layout);
}

// What a series brings with it: the layout of its modality, unless series are being compared; where it was
// never shown before its time points, and the CT under a PET.
Workspace MainWindow::arranged(Workspace workspace, const Series& series, bool isNew) const {
  if (!comparesSeries(workspace.layout)) workspace = inLayoutOf(std::move(workspace), series);
  if (!isNew) return workspace;
  workspace = withSlicesInFocus(std::move(workspace));
  workspace = withTimePointsOf(std::move(workspace), series, open_.volumes());
  const Series* ct = series.modality == "PT" && workspace.focus < firstComparedId ? ctUnder(series) : nullptr;
  return ct ? fusedWith(std::move(workspace), *ct) : workspace;
}

Session::Arrange MainWindow::arrangedFor(const Series& series) const {
  return [this, series](Workspace w, bool isNew) { return arranged(std::move(w), series, isNew); };
}

void MainWindow::keepLayouts() const {
  QSettings settings;
  for (const auto& [key, layout] : layoutsChosen_) settings.setValue(key, QLatin1String(layoutName(layout)));
}

void MainWindow::resetViewInFocus() {
  if (SliceView* slice = grid_->sliceView(session_.workspace().focus))
    slice->resetView();
  else
    view()->resetView();
}

}  // namespace volumen
