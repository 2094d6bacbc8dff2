#include <QDrag>

#include "results/text/text.h"
#include "ui/exports/dragged_pictures.h"
#include "ui/exports/views_picture.h"
#include "ui/features/exporting.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

MadePicture pictureOf(const View& view) { return {view.capture(), plainPictureText(view.warningsShown())}; }

// Copies or saves the view in focus or all views as they appear on screen. Starts drags of a view's picture.
class ViewPictures : public ExportFeature {
 public:
  explicit ViewPictures(Workbench& bench);

 private:
  PictureMakerPtr seen(bool isAll) const;
  void save(const PictureMakerPtr& seen, const QString& title);
  void dragOut(View* view);

  DraggedPictures dragged_;
};

ViewPictures::ViewPictures(Workbench& bench) : ExportFeature(bench) {
  const auto add = [&](const char* name, const QString& text, const QList<QKeySequence>& keys,
                       const char* icon, bool isAll, const QString& title, std::vector<Place> places) {
    const auto act = [this, isAll, title](bool) {
      if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
      title.isEmpty() ? run({{}, seen(isAll), clipboard()}) : save(seen(isAll), title);
    };
    bench_.addAction({name, text, keys, icon, false, act, std::move(places)});
  };
  add("savePicture", tr("Save picture..."), {tr("Ctrl+E")}, "snapshot", false,
      tr("Save the picture of the view"), {{"fileMenu", 50}, {"toolBar", 30, toolBarGap + 10}});
  add("copyPicture", tr("Copy picture"), {QKeySequence::Copy}, "", false, {}, {{"fileMenu", 50}});
  add("saveAllPictures", tr("Save all views..."), {}, "", true, tr("Save the picture of all views"),
      {{"fileMenu", 50, 10}});
  add("copyAllPictures", tr("Copy all views"), {tr("Ctrl+Shift+C")}, "", true, {}, {{"fileMenu", 50, 10}});
  connect(&grid_, &ViewGrid::pictureDragged, this, &ViewPictures::dragOut);
}

PictureMakerPtr ViewPictures::seen(bool isAll) const {
  View* view = grid_.viewShown();
  return viewsPicture(isAll ? grid_.viewsSeen() : std::vector{view}, session_, [this, isAll, view] {
    return isAll ? MadePicture{grid_.capture(), plainPictureText(grid_.warningsShown())} : pictureOf(*view);
  });
}

void ViewPictures::save(const PictureMakerPtr& seen, const QString& title) {
  const Series* series = seriesIn(session_.workspace(), session_.workspace().focus);
  const QString name = series ? fileName(*series) : QStringLiteral("volumen");
  askForPath({"pictureDialog", title, pictureFilters(), name + QStringLiteral(".png")},
             [this, seen](const QString& path) {
               run({JobName(tr("Saving"), path), seen, pictureFile(path)});
             });
}

// A drag cannot wait for a picture that is being drawn.
void ViewPictures::dragOut(View* view) {
  constexpr QSize underPointer(160, 160);
  const Series* series = seriesIn(session_.workspace(), view->id());
  if (!series) return;
  if (!view->hasItsPicture()) return warn(tr("The picture is still being drawn: drag it again in a moment."));
  MadePicture picture;
  QString name;
  {
    const HidingNames asExports(namesHidden() || session_.preferences().exportsWithoutIdentity);
    picture = pictureOf(*view), name = fileName(*series);
  }
  auto carried = dragged_.carry(picture, name);
  if (!carried) return warn(QString::fromStdString(carried.message()));
  takeBack();
  auto* drag = new QDrag(view);
  drag->setMimeData(carried->release());
  drag->setPixmap(
      QPixmap::fromImage(picture.image.scaled(underPointer, Qt::KeepAspectRatio, Qt::SmoothTransformation)));
  drag->exec(Qt::CopyAction);
}

}  // namespace

std::unique_ptr<Feature> makeViewPictures(Workbench& bench) { return std::make_unique<ViewPictures>(bench); }

}  // namespace volumen
