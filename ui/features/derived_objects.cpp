#include "ui/controller/derived_objects.h"

#include <QDockWidget>
#include <QFileInfo>
#include <QMenu>
#include <QPointer>
#include <algorithm>

#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "ui/features/feature.h"
#include "ui/features/go_to_picture.h"
#include "ui/panels/regions_panel.h"
#include "ui/panels/report_dialog.h"
#include "ui/tools/tool.h"
#include "ui/views/frame_view.h"
#include "ui/workspace/derived_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Shows objects that refer to pictures: presentation states, key objects, reports, contours and
// segmentations.
class DerivedObjectFiles : public Feature {
 public:
  explicit DerivedObjectFiles(Workbench& bench);

 private:
  void showAlone(const Study& study, std::optional<ViewId> onto);
  bool isOverWhatIsOpen(const DerivedObject& object) const;
  void showDerivedObject(const DerivedObjectPtr& object);
  void showPresentation(const DerivedObjectPtr& object);
  void showRegions(const DerivedObjectPtr& object);
  void showReport(const DerivedObjectPtr& object, const Report& report);
  void showPictureNamed(const ReferencedPicture& picture);
  void showPlace(const std::string& frameOfReferenceUid, glm::dvec3 pPatient);
  void fillPresentations(QMenu* menu, FlatView* view);

  QDockWidget* dock_;
  QPointer<ReportDialog> report_;
};

DerivedObjectFiles::DerivedObjectFiles(Workbench& bench) : Feature(bench) {
  DerivedObjects& derived = bench_.document.derived;
  auto* regions = new RegionsPanel(session_, derived);
  dock_ = bench_.addDock({"regions",
                          tr("Contours and segments"),
                          regions,
                          {Qt::RightDockWidgetArea, 70, false, Workbench::About::flat}});
  connect(regions, &RegionsPanel::placeChosen, this, &DerivedObjectFiles::showPlace);
  connect(regions, &RegionsPanel::segmentsRequested, &bench_, &Workbench::segmentsRequested);
  const auto setOpen = [this] { bench_.document.derived.setOpen(open_.derived()); };
  connect(&open_, &OpenStudies::changed, this, setOpen);
  whenChanged(session_, this, setOpen, &Preferences::hideNames);
  connect(&derived, &DerivedObjects::failed, this,
          [this](const QString& sentence) { warnUntilDone(shownText(sentence.toStdString())); });
  connect(&derived, &DerivedObjects::reportRead, this, &DerivedObjectFiles::showReport);
  connect(&bench_, &Workbench::objectChosen, this, &DerivedObjectFiles::showDerivedObject);
  // Waits until the study is in the list.
  connect(&bench_.document.loader, &Loader::studyOpened, this,
          [this](const QString&, const std::shared_ptr<const Study>& study, const OpenIntent& intent) {
            if (intent.isAlone && study->volumes.empty() && study->images.empty())
              showAlone(*study, intent.onto);
          });
  connect(&bench_, &Workbench::sliceMenuOpens, this, &DerivedObjectFiles::fillPresentations);
}

// Shows the object of a file without pictures, or says what it is and which pictures are missing. A
// segmentation dropped on a view becomes its segments.
void DerivedObjectFiles::showAlone(const Study& study, std::optional<ViewId> onto) {
  if (study.derived.empty()) return;
  if (study.derived.size() > 1)
    return warn(tr("%1 objects that refer to pictures: open these pictures, then click an object in the list "
                   "of studies.")
                    .arg(study.derived.size()));
  const DerivedKey key = keyOf(study.derived.front());
  for (const DerivedObjectPtr& object : open_.derived()) {
    if (keyOf(*object) != key) continue;
    const bool hasEffect = object->kind == DerivedKind::report || isOverWhatIsOpen(*object);
    if (!hasEffect) return warn(aloneText(*object));
    if (!onto || object->kind != DerivedKind::segmentation) return showDerivedObject(object);
    session_.setFocus(*onto);
    return Q_EMIT bench_.segmentsRequested({QString::fromStdString(object->path)});
  }
}

bool DerivedObjectFiles::isOverWhatIsOpen(const DerivedObject& object) const {
  const std::vector<const Series*> open = open_.pictures();
  const auto isHere = [&](const ReferencedPicture& picture) {
    return findPicture(open, picture).has_value();
  };
  const std::string& frame = object.frameOfReferenceUid;
  const bool isPlaced = object.kind == DerivedKind::contours || object.kind == DerivedKind::segmentation;
  const auto isIn = [&](const Series* series) { return series->frameOfReferenceUid == frame; };
  return std::ranges::any_of(object.pictures, isHere) ||
         (isPlaced && !frame.empty() && std::ranges::any_of(open, isIn));
}

void DerivedObjectFiles::showDerivedObject(const DerivedObjectPtr& object) {
  switch (object->kind) {
    case DerivedKind::presentation:
      return showPresentation(object);
    case DerivedKind::report:
      return bench_.document.derived.readReport(object);
    case DerivedKind::contours:
    case DerivedKind::segmentation:
      return showRegions(object);
    case DerivedKind::keyObjects:
      break;
  }
  const std::vector<const Series*> open = open_.pictures();
  for (const ReferencedPicture& picture : object->pictures)
    if (findPicture(open, picture)) return showPictureNamed(picture);
  warn(tr("None of the pictures that %1 marks is open.").arg(derivedName(*object)),
       open_.filesWithoutPixels());
}

void DerivedObjectFiles::showPresentation(const DerivedObjectPtr& object) {
  const std::vector<const Series*> open = open_.pictures();
  for (const ReferencedPicture& picture : object->pictures) {
    const std::optional<PicturePlace> place = findPicture(open, picture);
    if (!place) continue;
    const Series series = *place->series;
    return showAsFrame(bench_, derivedName(*object), series, place->index, keyOf(*object));
  }
  const QStringList without = open_.filesWithoutPixels();
  const QString sentence = tr("None of the pictures that %1 is for can be shown.").arg(derivedName(*object));
  warn(without.isEmpty() ? sentence : sentence + QLatin1Char(' ') + without.join(QLatin1Char(' ')));
}

// Shows regions over views of their frame of reference, or opens a series for them if there is none.
void DerivedObjectFiles::showRegions(const DerivedObjectPtr& object) {
  dock_->show();
  dock_->raise();
  const RegionsLook look = firstLook(*object);
  session_.change(tr("Show %1").arg(derivedName(*object)),
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
  if (found) return bench_.document.opener.show(*found);
  warn(tr("No series of the frame of reference of %1 is open: it is shown once one is.")
           .arg(derivedName(*object)));
}

void DerivedObjectFiles::showReport(const DerivedObjectPtr& object, const Report& report) {
  if (report_) report_->close();
  report_ = new ReportDialog(session_, object, report, open_.pictures(), bench_.dialogParent());
  connect(report_, &ReportDialog::pictureChosen, this, &DerivedObjectFiles::showPictureNamed);
  report_->show();
}

void DerivedObjectFiles::showPictureNamed(const ReferencedPicture& picture) {
  const std::optional<PicturePlace> place = findPicture(open_.pictures(), picture);
  if (place) showPicture(bench_, *place->series, place->index);
}

void DerivedObjectFiles::showPlace(const std::string& frameOfReferenceUid, glm::dvec3 pPatient) {
  if (frameOfReferenceUid.empty()) return;
  for (const ViewId id : viewsOnScreen(session_.workspace())) {
    const LoadedSeriesPtr shown = session_.seriesOf(id);
    if (!shown || shown->series.frameOfReferenceUid != frameOfReferenceUid) continue;
    moveCrosshair(session_, id, *shown, tr("Go to region"), pPatient);
    return session_.endGesture();
  }
  tell(tr("No slices of its frame of reference are on screen."));
}

// Lists the presentation states of the frame on screen, and "none".
void DerivedObjectFiles::fillPresentations(QMenu* menu, FlatView* view) {
  const Series* series = seriesIn(session_.workspace(), view->id());
  const auto* frames = qobject_cast<FrameView*>(view);
  if (!frames || !frames->frame() || !series) return;
  const auto states =
      bench_.document.derived.naming(DerivedKind::presentation, *series, frames->frame()->key.index);
  const DerivedKey chosen = flatLookOf(view->state()).presentation;
  if (states.empty() && chosen.empty()) return;
  QMenu* choices = menu->addMenu(tr("Presentation state"));
  choices->setObjectName(QStringLiteral("presentationMenu"));
  const auto add = [&](const QString& text, const DerivedKey& key) {
    QAction* action = choices->addAction(text, this, [this, id = view->id(), key] {
      session_.endGesture();
      session_.change(tr("Presentation state"), withPresentation(session_.workspace(), id, key));
      session_.endGesture();
    });
    action->setCheckable(true);
    action->setChecked(key == chosen);
  };
  add(tr("None"), {});
  for (const DerivedObjectPtr& object : states) {
    QString name = shownText(object->label);
    if (name.isEmpty()) name = QFileInfo(pathText(object->path)).fileName();
    if (const QString text = shownText(object->text); !text.isEmpty())
      name += QStringLiteral(" (%1)").arg(text);
    add(name.replace(QLatin1Char('&'), QStringLiteral("&&")), keyOf(*object));
  }
}

}  // namespace

std::unique_ptr<Feature> makeDerivedObjects(Workbench& bench) {
  return std::make_unique<DerivedObjectFiles>(bench);
}

}  // namespace volumen
