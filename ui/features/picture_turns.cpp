#include <QMenu>
#include <QScreen>
#include <cmath>

#include "ui/features/feature.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Rotates, flips and sizes the picture of the slice or frame in focus.
class PictureTurns : public Feature {
 public:
  explicit PictureTurns(Workbench& bench);

 private:
  void makeTurns();
  void makeSizes();
  void add(const char* name, const QString& text, const QString& key, const Place& place,
           const std::function<void(FlatView&)>& run);
  void showTrueSize(FlatView& view);
  void zoom(FlatView& view, double mmPerPixel);
};

PictureTurns::PictureTurns(Workbench& bench) : Feature(bench) {
  QMenu* turns = bench_.addMenu("turnMenu", tr("Turn and size"), {{"viewMenu", 60, 65}});
  makeTurns();
  makeSizes();
  connect(&bench_, &Workbench::sliceMenuOpens, this, [turns](QMenu* menu) { menu->addMenu(turns); });
}

void PictureTurns::add(const char* name, const QString& text, const QString& key, const Place& place,
                       const std::function<void(FlatView&)>& run) {
  const auto act = [this, run](bool) {
    FlatView* view = bench_.flatViewInFocus();
    if (!view || !view->shown()) return warn(tr("Click a slice or a frame first."));
    run(*view);
  };
  bench_.addAction({name, text, {key}, "", false, act, {place}});
}

void PictureTurns::makeTurns() {
  const std::tuple<const char*, QString, QString, PictureTurn> turns[] = {
      {"turnRight", tr("Turn right"), tr("Ctrl+R"), {1, false}},
      {"turnLeft", tr("Turn left"), tr("Ctrl+Shift+R"), {3, false}},
      {"mirror", tr("Mirror left to right"), tr("Ctrl+H"), {0, true}},
      {"mirrorUpright", tr("Mirror top to bottom"), tr("Ctrl+Shift+H"), {2, true}}};
  for (const auto& [name, text, key, by] : turns)
    add(name, text, key, {"turnMenu", 10},
        [text = text, by = by](FlatView& view) { view.turnPicture(text, by); });
}

void PictureTurns::makeSizes() {
  add("ownPixels", tr("A pixel of the picture a pixel of the screen"), tr("O"), {"turnMenu", 20},
      [this](FlatView& view) { zoom(view, view.ownPixelMm()); });
  add("trueSize", tr("True size"), tr("Shift+O"), {"turnMenu", 20},
      [this](FlatView& view) { showTrueSize(view); });
}

void PictureTurns::showTrueSize(FlatView& view) {
  if (view.overlays().mmPerPixel <= 0) return warn(tr("The file does not say how large this picture is."));
  const QScreen* screen = view.screen();
  if (screen->physicalSize().isEmpty()) return warn(tr("The screen does not say how large it is."));
  zoom(view, 25.4 / (screen->physicalDotsPerInch() * view.devicePixelRatioF()));
}

void PictureTurns::zoom(FlatView& view, double mmPerPixel) {
  view.zoomTo(mmPerPixel);
  if (std::abs(view.plane()->mmPerPixel / mmPerPixel - 1) > 1e-6)
    warn(tr("The view is too large or too small for that size."));
}

}  // namespace

std::unique_ptr<Feature> makePictureTurns(Workbench& bench) { return std::make_unique<PictureTurns>(bench); }

}  // namespace volumen
