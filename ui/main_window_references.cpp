#include <QActionGroup>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenu>

#include "ui/data/frame_series.h"
#include "ui/main_window.h"
#include "ui/panels/key_images_panel.h"
#include "ui/panels/regions_panel.h"
#include "ui/panels/report_dialog.h"
#include "ui/panels/studies_panel.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/key_images.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// The flat view on screen that shows slices of a series; none: there is none.
std::optional<ViewId> slicesViewOf(const Workspace& workspace, const SeriesKey& series) {
  for (const ViewId id : viewsOnScreen(workspace)) {
    const ViewState& view = workspace.view(id);
    if (view.kind != ViewKind::volume && view.kind != ViewKind::frames && view.series == series) return id;
  }
  return {};
}

// Shown by a presentation state, or, where that is empty, as acquired; windows of before do not hold.
Workspace withPresentation(Workspace workspace, ViewId view, const ReferenceKey& presentation) {
  ViewState& state = workspace.editView(view);
  FlatLook& look = state.flats.editOrAdd(state.series);
  if (look.presentation == presentation) return workspace;
  look.presentation = presentation;
  look.inverted = false;
  makeWhole(look);
  SeriesState& series = workspace.series.edit(state.series);
  series.window.reset();
  series.namedGrey = 0;
  return workspace;
}

}  // namespace

void MainWindow::makeReferenceActions() {
  const auto add = [this](const char* name, const QString& text, const QString& word, const QString& key,
                          auto run) {
    auto* action = new QAction(text, this);
    action->setIconText(word);  // of its button
    action->setObjectName(QLatin1String(name));
    action->setShortcut(key);
    addAction(action);
    connect(action, &QAction::triggered, this, run);
    actions_[action->objectName()] = action;
  };
  add("keyImage", tr("Key image"), tr("Mark"), tr("K"), [this] { toggleKeyImage(); });
  add("previousKeyImage", tr("Previous key image"), tr("Previous"), tr(","), [this] { goToKeyImage(-1); });
  add("nextKeyImage", tr("Next key image"), tr("Next"), tr("."), [this] { goToKeyImage(1); });
}

void MainWindow::makeReferenceDocks() {
  QList<QAction*> actions;
  for (const char* name : {"keyImage", "previousKeyImage", "nextKeyImage"})
    actions << actions_.at(QLatin1String(name));
  keyImages_ = new KeyImagesPanel(
      session_, references_, [this] { return open_.pictures(); }, actions);
  addDock(QStringLiteral("keyImages"), tr("Key images"), keyImages_, Qt::RightDockWidgetArea);
  auto* regions = new RegionsPanel(session_, references_);
  addDock(QStringLiteral("regions"), tr("Contours and segments"), regions, Qt::RightDockWidgetArea);
  connect(keyImages_, &KeyImagesPanel::pictureChosen, this, &MainWindow::showPicture);
  connect(regions, &RegionsPanel::placeChosen, this, &MainWindow::showPlace);
}

void MainWindow::connectReferences() {
  connect(&open_, &OpenStudies::changed, this, [this] { references_.setOpen(open_.references()); });
  connect(studies_, &StudiesPanel::referenceChosen, this, &MainWindow::showReference);
  connect(&references_, &References::failed, this,
          [this](const QString& sentence) { banner_->tell(shownText(sentence.toStdString())); });
  connect(&references_, &References::reportRead, this, &MainWindow::showReport);
}

void MainWindow::showReference(const ReferencePtr& object) {
  switch (object->kind) {
    case ReferenceKind::presentation:
      return showPresentation(object);
    case ReferenceKind::report:
      return references_.readReport(object);
    case ReferenceKind::contours:
    case ReferenceKind::segmentation:
      return showRegions(object);
    case ReferenceKind::keyObjects:
      break;
  }
  const std::vector<const Series*> open = open_.pictures();
  for (const ReferencedPicture& picture : object->pictures)
    if (findPicture(open, picture)) return showPictureNamed(picture);
  banner_->tell(tr("None of the pictures that %1 marks is open.").arg(referenceName(*object)),
                open_.filesWithoutPixels());
}

void MainWindow::showPresentation(const ReferencePtr& object) {
  const std::vector<const Series*> open = open_.pictures();
  for (const ReferencedPicture& picture : object->pictures) {
    const std::optional<PicturePlace> place = findPicture(open, picture);
    if (!place) continue;
    const Series series = *place->series;
    return showAsFrame(referenceName(*object), series, place->index, keyOf(*object));
  }
  const QStringList without = open_.filesWithoutPixels();
  const QString sentence =
      tr("None of the pictures that %1 is for can be shown.").arg(referenceName(*object));
  banner_->tell(without.isEmpty() ? sentence : sentence + QLatin1Char(' ') + without.join(QLatin1Char(' ')));
}

// Over the views of its frame of reference; where there is none, over a series that is opened for it.
void MainWindow::showRegions(const ReferencePtr& object) {
  QDockWidget* dock = docks_.at(QStringLiteral("regions"));
  dock->show();
  dock->raise();
  const RegionsLook look = firstLook(*object);
  session_.change(tr("Show %1").arg(referenceName(*object)),
                  [&](Workspace& w) { w.regions.add(keyOf(*object), look); });
  session_.endGesture();
  const auto isIn = [&](const Series& series) {
    return !look.frameOfReferenceUid.empty() && series.frameOfReferenceUid == look.frameOfReferenceUid;
  };
  for (const ViewId id : viewsOnScreen(session_.workspace()))
    if (const Series* shown = seriesIn(session_.workspace(), id); shown && isIn(*shown)) return;
  const Series* found = nullptr;
  for (const Series* series : open_.volumes())
    if (isIn(*series) && (!found || series->modality == "CT")) found = series;
  if (found) return showInFocus(*found);
  banner_->tell(tr("No series of the frame of reference of %1 is open: it is shown once one is.")
                    .arg(referenceName(*object)));
}

void MainWindow::showReport(const ReferencePtr& object, const Report& report) {
  for (ReportDialog* before : findChildren<ReportDialog*>()) before->close();
  auto* dialog = new ReportDialog(*object, report, open_.pictures(), this);
  connect(dialog, &ReportDialog::pictureChosen, this, &MainWindow::showPictureNamed);
  dialog->show();
}

void MainWindow::showPictureNamed(const ReferencedPicture& picture) {
  const std::optional<PicturePlace> place = findPicture(open_.pictures(), picture);
  if (place) showPicture(*place->series, place->index);
}

// As a slice where one of the series is on screen, else as a frame.
void MainWindow::showPicture(const Series& shown, int index) {
  const Series series = shown;
  session_.endGesture();
  const QString text = tr("Go to picture");
  const auto view = slicesViewOf(session_.workspace(), keyOf(series));
  if (const std::optional<int> slice = drawnSlice(series, index); view && slice) {
    session_.setFocus(*view);
    const ShownSeriesPtr held = session_.seriesOf(*view);
    if (held) {
      const VoxelGeometry& geometry = drawnGeometry(series);
      glm::dvec3 pVoxel = geometry.voxelFromPatient(crosshairOf(session_.workspace(), *view, *held).at);
      pVoxel.z = *slice;
      moveCrosshair(session_, *view, *held, text, geometry.patientFromVoxel(pVoxel));
      return session_.endGesture();
    }
  }
  showAsFrame(text, series, index, {});
}

// In the view in focus; one step. By a presentation state, or, where that is empty, as it was shown there.
void MainWindow::showAsFrame(const QString& text, const Series& series, int index,
                             const ReferenceKey& presentation) {
  loader_.cancelLoad();
  const ViewId view = framesViewOf(session_.workspace().focus);
  if (session_.workspace().series.empty()) session_.showFrames(series, view);
  Workspace after = withFrames(session_.workspace(), view, series);
  after.editView(view).flats.editOrAdd(keyOf(series)).frame = index;
  if (!presentation.empty()) after = withPresentation(std::move(after), view, presentation);
  session_.change(text, std::move(after));
  session_.endGesture();
}

void MainWindow::showPlace(const std::string& frameOfReferenceUid, glm::dvec3 pPatient) {
  if (frameOfReferenceUid.empty()) return;
  for (const ViewId id : viewsOnScreen(session_.workspace())) {
    const ShownSeriesPtr shown = session_.seriesOf(id);
    if (!shown || shown->series.frameOfReferenceUid != frameOfReferenceUid) continue;
    moveCrosshair(session_, id, *shown, tr("Go to region"), pPatient);
    return session_.endGesture();
  }
  status_->tell(tr("No slices of its frame of reference are on screen."));
}

// The flat view that keys are for; null: there is none.
SliceView* MainWindow::sliceViewInFocus() const {
  const Workspace& workspace = session_.workspace();
  return showsFrames(workspace, workspace.focus) ? framesInFocus() : grid_->sliceView(workspace.focus);
}

void MainWindow::toggleKeyImage() {
  SliceView* view = sliceViewInFocus();
  const auto [picture, interpolated] = view ? view->pictureSeen() : PictureSeen();
  if (interpolated)
    return status_->tell(
        tr("This slice is interpolated between those that were acquired: scroll to one of these, "
           "or choose View > Show as frames."));
  if (!picture)
    return status_->tell(
        tr("Only pictures as acquired can be key images: choose a view along the slices, or View > "
           "Show as frames."));
  const Series* series = seriesIn(session_.workspace(), view->id());
  const std::optional<KeyImage> image = keyImageOf(*series, *picture);
  if (!image) return status_->tell(tr("Only pictures of DICOM files can be key images."));
  const bool was = isKeyImage(session_.workspace(), *image);
  session_.endGesture();
  session_.change(was ? tr("Remove key image") : tr("Key image"),
                  withKeyImageToggled(session_.workspace(), *image));
  session_.endGesture();
}

void MainWindow::goToKeyImage(int step) {
  SliceView* view = sliceViewInFocus();
  const std::optional<int> picture = view ? view->pictureSeen().index : std::nullopt;
  const SeriesKey series = view ? view->state().series : SeriesKey{};
  const std::optional<PicturePlace> next = keyImages_->next(series, picture.value_or(-1), step);
  if (!next) return status_->tell(tr("There are no key images: K marks the picture that is shown."));
  showPicture(*next->series, next->index);
}

// Those that are for the frame on screen, and none.
void MainWindow::fillPresentations(QMenu* menu, SliceView& view) {
  const Series* series = seriesIn(session_.workspace(), view.id());
  if (!view.showsFrames() || !view.frame() || !series) return;
  const auto states = references_.naming(ReferenceKind::presentation, *series, view.frame()->key.index);
  const ReferenceKey chosen = flatLookOf(view.state()).presentation;
  if (states.empty() && chosen.empty()) return;
  QMenu* choices = menu->addMenu(tr("Presentation state"));
  choices->setObjectName(QStringLiteral("presentationMenu"));
  const auto add = [&](const QString& text, const ReferenceKey& key) {
    QAction* action = choices->addAction(text, this, [this, id = view.id(), key] {
      session_.endGesture();
      session_.change(tr("Presentation state"), withPresentation(session_.workspace(), id, key));
      session_.endGesture();
    });
    action->setCheckable(true);
    action->setChecked(key == chosen);
  };
  add(tr("None"), {});
  for (const ReferencePtr& object : states) {
    QString name = shownText(object->label);
    if (name.isEmpty()) name = QFileInfo(pathText(object->path)).fileName();
    if (const QString text = shownText(object->text); !text.isEmpty())
      name += QStringLiteral(" (%1)").arg(text);
    add(name.replace(QLatin1Char('&'), QStringLiteral("&&")), keyOf(*object));
  }
}

}  // namespace volumen
