#include <QEvent>
#include <QStackedWidget>
#include <QTimer>

#include "ui/features/feature.h"
#include "ui/views/first_image.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

constexpr int momentMs = 100;  // what is loaded within it is shown at once

// Something to look at while a series is being loaded: one of its slices, over the view that it will be in.
class FirstImages : public Feature {
 public:
  explicit FirstImages(Workbench& bench);

  bool eventFilter(QObject* pages, QEvent* event) override;

 private:
  void begin(const Series& series);
  void endWhenDrawn();
  void place();

  FirstImage* image_;
  std::shared_ptr<const Series> loading_;
  QTimer soon_;
};

FirstImages::FirstImages(Workbench& bench)
    : Feature(bench), image_(new FirstImage(bench.document.frames, bench.document.slices, &bench.pages)) {
  bench_.pages.installEventFilter(this);
  soon_.setSingleShot(true);
  soon_.setInterval(momentMs);
  Loader& loader = bench_.document.loader;
  connect(&soon_, &QTimer::timeout, image_, [this] { image_->begin(loading_); });
  connect(image_, &FirstImage::appears, this, &FirstImages::place);
  connect(&loader, &Loader::loadBegan, this, [this](const Series& series) {
    loading_ = std::make_shared<const Series>(series);
    image_->end();
    soon_.start();
  });
  const auto end = [this] {
    soon_.stop();
    image_->end();
  };
  connect(&loader, &Loader::notLoaded, this, end);
  connect(&loader, &Loader::loadGivenUp, this, end);
  connect(&loader, &Loader::seriesLoaded, this, &FirstImages::endWhenDrawn);
}

bool FirstImages::eventFilter(QObject* pages, QEvent* event) {
  if (event->type() == QEvent::Resize && image_->isVisible()) place();
  return Feature::eventFilter(pages, event);
}

// Where nothing is shown yet it has all of the place, else that of the view in focus.
void FirstImages::place() {
  const bool isAlone = bench_.pages.currentWidget() != &grid_;
  const QWidget* over = isAlone ? bench_.pages.currentWidget() : static_cast<QWidget*>(grid_.viewShown());
  image_->setGeometry(QRect(over->mapTo(&bench_.pages, QPoint(0, 0)), over->size()));
  image_->raise();
}

// The views have the series; until they have drawn it the slice stays.
void FirstImages::endWhenDrawn() {
  soon_.stop();
  const auto* flat = qobject_cast<FlatView*>(grid_.viewShown());
  if (image_->isHidden() || !flat || !flat->picture().isNull()) return image_->end();
  place();
  connect(flat, &FlatView::settled, image_, &FirstImage::end, Qt::SingleShotConnection);
}

}  // namespace

std::unique_ptr<Feature> makeFirstImages(Workbench& bench) { return std::make_unique<FirstImages>(bench); }

}  // namespace volumen
