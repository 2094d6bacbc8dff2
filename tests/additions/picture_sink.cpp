// An addition: another place for pictures of the view in focus.
#include "ui/exports/views_picture.h"
#include "ui/features/exporting.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

PictureSink bitmap(const QString& path) {
  const auto take = [path](std::size_t, const MadePicture& picture) {
    return picture.image.save(path, "BMP") ? Status() : Error{"Cannot write the bitmap."};
  };
  return {take, [](std::size_t) { return Result(QStringLiteral("Saved the bitmap")); }};
}

class Bitmaps : public ExportFeature {
 public:
  explicit Bitmaps(Workbench& bench) : ExportFeature(bench) {
    bench_.addAction(
        {"saveBitmap", tr("Bitmap..."), {}, "", false, [this](bool) { ask(); }, {{"fileMenu", 50, 20}}});
  }

 private:
  void ask() {
    View* view = grid_.viewShown();
    const PictureMakerPtr seen = viewsPicture({view}, session_, [view] {
      return MadePicture{view->capture(), {}};
    });
    askForPath({"bitmapDialog", tr("Save a bitmap"), tr("Bitmaps (*.bmp)"), tr("view.bmp")},
               [this, seen](const QString& path) {
                 run({tr("Saving the bitmap"), seen, bitmap(path)});
               });
  }
};

}  // namespace

std::unique_ptr<Feature> makeBitmaps(Workbench& bench) { return std::make_unique<Bitmaps>(bench); }

}  // namespace volumen
