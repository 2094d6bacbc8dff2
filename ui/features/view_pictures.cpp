#include "results/text/text.h"
#include "ui/exports/views_picture.h"
#include "ui/features/exporting.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Copies or saves the view in focus or all views as they appear on screen.
class ViewPictures : public ExportFeature {
 public:
  explicit ViewPictures(Workbench& bench);

 private:
  PictureMakerPtr seen(bool isAll) const;
  void save(const PictureMakerPtr& seen, const QString& title);
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
}

PictureMakerPtr ViewPictures::seen(bool isAll) const {
  View* view = grid_.viewShown();
  return viewsPicture(isAll ? grid_.viewsSeen() : std::vector{view}, session_, [this, isAll, view] {
    return isAll ? MadePicture{grid_.capture(), plainPictureText(grid_.warningsShown())}
                 : MadePicture{view->capture(), plainPictureText(view->warningsShown())};
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

}  // namespace

std::unique_ptr<Feature> makeViewPictures(Workbench& bench) { return std::make_unique<ViewPictures>(bench); }

}  // namespace volumen
