#include <QMenu>

#include "ui/features/feature.h"
#include "ui/features/go_to_picture.h"
#include "ui/panels/key_images_panel.h"
#include "ui/views/flat_view.h"
#include "ui/workspace/key_images.h"

namespace volumen {

namespace {

// Marks key images by a key, lists them and steps through them.
class KeyImages : public Feature {
 public:
  explicit KeyImages(Workbench& bench);

 private:
  QAction* add(const char* name, const QString& text, const QString& word, const char* key,
               std::function<void()> run);
  void toggleKeyImage();
  void goToKeyImage(int step);

  KeyImagesPanel* panel_;
};

KeyImages::KeyImages(Workbench& bench) : Feature(bench) {
  const QList<QAction*> actions{
      add("keyImage", tr("Key image"), tr("Mark"), "K", [this] { toggleKeyImage(); }),
      add("previousKeyImage", tr("Previous key image"), tr("Previous"), ",", [this] { goToKeyImage(-1); }),
      add("nextKeyImage", tr("Next key image"), tr("Next"), ".", [this] { goToKeyImage(1); })};
  panel_ = new KeyImagesPanel(
      session_, bench_.document.derived, [this] { return open_.pictures(); }, actions);
  bench_.addDock(
      {"keyImages", tr("Key images"), panel_, {Qt::RightDockWidgetArea, 60, false, Workbench::About::flat}});
  connect(&bench_, &Workbench::sliceMenuOpens, this,
          [mark = actions.front()](QMenu* menu) { menu->addAction(mark); });
  connect(panel_, &KeyImagesPanel::pictureChosen, this,
          [this](const Series& series, int index) { showPicture(bench_, series, index); });
}

QAction* KeyImages::add(const char* name, const QString& text, const QString& word, const char* key,
                        std::function<void()> run) {
  QAction* action = bench_.addAction({name,
                                      text,
                                      {QKeySequence(QLatin1String(key))},
                                      "",
                                      false,
                                      [run = std::move(run)](bool) { run(); },
                                      {{"toolsMenu", 40}}});
  action->setIconText(word);  // text of the action's button
  return action;
}

void KeyImages::toggleKeyImage() {
  FlatView* view = bench_.flatViewInFocus();
  const auto [picture, interpolated] = view ? view->stack().seen : PictureSeen();
  if (interpolated)
    return tell(
        tr("This slice is interpolated between those that were acquired: scroll to one of these, "
           "or choose View > Show as frames."));
  if (!picture)
    return tell(
        tr("Only pictures as acquired can be key images: choose a view along the slices, or View > "
           "Show as frames."));
  const Series* series = seriesIn(session_.workspace(), view->id());
  std::optional<KeyImage> image = keyImageOf(*series, *picture);
  if (!image) return tell(tr("Only pictures of DICOM files can be key images."));
  image->window = flatLookOf(view->state()).windowAlone;
  const bool was = isKeyImage(session_.workspace(), *image);
  session_.endGesture();
  session_.change(was ? tr("Remove key image") : tr("Key image"),
                  withKeyImageToggled(session_.workspace(), *image));
  session_.endGesture();
}

void KeyImages::goToKeyImage(int step) {
  FlatView* view = bench_.flatViewInFocus();
  const std::optional<int> picture = view ? view->stack().seen.index : std::nullopt;
  const SeriesKey series = view ? view->state().series : SeriesKey{};
  const std::optional<PicturePlace> next = panel_->next(series, picture.value_or(-1), step);
  if (!next) return tell(tr("There are no key images: K marks the picture that is shown."));
  showPicture(bench_, *next->series, next->index);
}

}  // namespace

std::unique_ptr<Feature> makeKeyImages(Workbench& bench) { return std::make_unique<KeyImages>(bench); }

}  // namespace volumen
