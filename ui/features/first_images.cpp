#include <QEvent>
#include <QStackedWidget>
#include <QTimer>
#include <algorithm>

#include "results/series/time_points.h"
#include "ui/features/feature.h"
#include "ui/views/first_image.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

constexpr int momentMs = 100;  // a series loaded within this time is shown without a first image

// Shows one slice of a series while it is being fetched or loaded, over the view that waits for it or will
// take it. What the user shows meanwhile ends it.
class FirstImages : public Feature {
 public:
  explicit FirstImages(Workbench& bench);

  bool eventFilter(QObject* pages, QEvent* event) override;

 private:
  void connectSource(StudySource& source);
  void begin(const Series& series);
  void end();
  void followArrival(const std::shared_ptr<const Series>& part);
  void endArrival();
  SeriesKey inFocus() const { return session_.workspace().view(session_.workspace().focus).series; }
  void followLoad();
  void look();
  void lookSoon();
  SeriesState stateOfIt() const;
  View* viewOfIt() const;
  const QWidget* takenByIt() const;
  bool hasNothing(const View& view) const;

  FirstImage* image_;
  std::shared_ptr<const Series> series_;  // null if no series is being loaded or it is already visible
  bool isInView_ = false, isLoaded_ = false;
  // Of what is being fetched: whether series_ is a part of it, whether no more comes, the series in focus
  // before it, and the id of one that gave way to what the user showed.
  bool isPart_ = false, isAllHere_ = false;
  SeriesKey before_;
  std::string gaveWay_;
  QTimer moment_, soon_;
};

FirstImages::FirstImages(Workbench& bench)
    : Feature(bench), image_(new FirstImage(bench.document.frames, bench.document.slices, &bench.pages)) {
  bench_.pages.installEventFilter(this);
  moment_.setSingleShot(true);
  moment_.setInterval(momentMs);
  soon_.setSingleShot(true);
  soon_.setInterval(0);
  connect(&moment_, &QTimer::timeout, this, [this] {
    look();
    if (series_) image_->begin(stateOfIt(), false);
  });
  connect(&soon_, &QTimer::timeout, this, &FirstImages::look);
  connect(image_, &FirstImage::appears, this, &FirstImages::look);
  connect(&bench_.document.loader, &Loader::loadingChanged, this, &FirstImages::followLoad);
  connect(&bench_.document.loader, &Loader::idle, this, [this] {
    if (isAllHere_) endArrival();
  });
  StudySources& sources = bench_.document.sources;
  for (const auto& source : sources.all()) connectSource(*source);
  connect(&sources, &StudySources::added, this,
          [this, &sources](std::size_t number) { connectSource(*sources.all()[number]); });
  connect(&bench_.document.slices, &SliceService::failed, this, [this](int view) {
    const View* shown = series_ ? viewOfIt() : nullptr;
    if (view == firstImageId || (shown && shown->id() == view)) end();
  });
  connect(&session_, &Session::workspaceChanged, this, &FirstImages::lookSoon);
  connect(&grid_, &ViewGrid::arranged, this, &FirstImages::lookSoon);
}

bool FirstImages::eventFilter(QObject* pages, QEvent* event) {
  if (event->type() == QEvent::Resize) lookSoon();
  return Feature::eventFilter(pages, event);
}

void FirstImages::connectSource(StudySource& source) {
  connect(&source, &StudySource::arriving, this, &FirstImages::followArrival);
}

// Shows what came so far. Once all is here, it stays until the series is loaded.
void FirstImages::followArrival(const std::shared_ptr<const Series>& part) {
  isAllHere_ = !part;
  if (!part) {
    gaveWay_.clear();
    if (!bench_.document.loader.isBusy()) endArrival();
    return;
  }
  if (bench_.document.loader.isLoading() || part->id == gaveWay_) return;
  const bool goesOn = isPart_ && series_->id == part->id;
  if (!goesOn) end();
  series_ = part;
  if (goesOn) return image_->goOn(stateOfIt(), true);
  isPart_ = true;
  before_ = inFocus();
  look();
  image_->begin(stateOfIt(), true);
}

void FirstImages::endArrival() {
  if (isPart_) end();
}

void FirstImages::begin(const Series& series) {
  end();
  series_ = std::make_shared<const Series>(series);
  moment_.start();
}

void FirstImages::end() {
  moment_.stop();
  series_.reset();
  isInView_ = isLoaded_ = isPart_ = false;
  image_->end();
}

void FirstImages::followLoad() {
  if (const auto loading = bench_.document.loader.loading()) {
    const bool isRest = isPart_ && series_->id == loading->id;
    if (isPart_ && !isRest) gaveWay_ = series_->id;
    if (!isRest) return begin(*loading);
    isPart_ = false;
    series_ = loading;
    image_->goOn(stateOfIt(), false);
    return lookSoon();
  }
  if (!series_) return;
  isLoaded_ = session_.pool().peek({keyOf(*series_), {}}) != nullptr;
  if (!isLoaded_ || image_->isHidden()) return end();
  lookSoon();
}

// Waits until all views have handled the change.
void FirstImages::lookSoon() {
  if (series_) soon_.start();
}

// Returns how the series will be shown, as far as known.
SeriesState FirstImages::stateOfIt() const {
  const Workspace& workspace = session_.workspace();
  const View* view = viewOfIt();
  const auto known = workspace.series.find(keyOf(*series_));
  SeriesState state;
  if (view)
    state = seriesStateIn(workspace, view->id());
  else if (known != workspace.series.end())
    state = known->second;
  state.series = series_;
  return state;
}

// Returns the view that holds the series, preferring the one in focus, or null.
View* FirstImages::viewOfIt() const {
  View* found = nullptr;
  for (const ViewId id : viewsOnScreen(session_.workspace())) {
    View* view = grid_.viewAs<View>(id);
    const bool isIts = view && view->isVisibleTo(&grid_) && view->state().series == keyOf(*series_) &&
                       !showsFrames(view->state().kind);
    if (isIts && (!found || view == grid_.viewShown())) found = view;
  }
  return found;
}

// Returns the widget that will show the series if no view holds it yet: the view in focus, or the start page.
// Null if it is an overlay or another time point of a series that stays on screen meanwhile.
const QWidget* FirstImages::takenByIt() const {
  const Workspace& workspace = session_.workspace();
  for (const ViewId id : viewsOnScreen(workspace))
    if (flatLookOf(workspace.view(id)).overlay == keyOf(*series_)) return nullptr;
  const QWidget* page = bench_.pages.currentWidget();
  if (page != &grid_ && !isInSecond(workspace.focus)) return page;
  const View* view = grid_.viewShown();
  const Series* shown = seriesIn(workspace, view->id());
  return shown && areTimePoints(*shown, *series_) ? nullptr : view;
}

// Returns whether the view has no picture yet.
bool FirstImages::hasNothing(const View& view) const {
  if (const auto* flat = qobject_cast<const FlatView*>(&view)) return flat->picture().isNull();
  return !isLoaded_ && static_cast<const VolumeView&>(view).picture().isNull();
}

void FirstImages::look() {
  if (!series_) return;
  if (isPart_ && inFocus() != before_) {
    gaveWay_ = series_->id;
    return end();
  }
  const View* view = viewOfIt();
  const bool isOver = view ? hasNothing(*view) : !isInView_ && !isLoaded_;
  const QWidget* over = !isOver ? nullptr : view ? view : takenByIt();
  if (!over) return end();
  isInView_ = isInView_ || view;
  if (const auto* flat = qobject_cast<const FlatView*>(view))
    connect(flat, &FlatView::settled, this, &FirstImages::lookSoon, Qt::UniqueConnection);
  QWidget* ground = bench_.pages.isAncestorOf(over) ? static_cast<QWidget*>(&bench_.pages) : over->window();
  if (image_->parentWidget() != ground) {
    const bool isSeen = !image_->isHidden();
    image_->setParent(ground);
    image_->setVisible(isSeen);
  }
  const QRect place(over->mapTo(ground, QPoint(0, 0)), over->size());
  const bool isMoved = place != image_->geometry();
  image_->setGeometry(place);
  if (isMoved && image_->isHidden()) image_->askForPicture();
  image_->raise();
}

}  // namespace

std::unique_ptr<Feature> makeFirstImages(Workbench& bench) { return std::make_unique<FirstImages>(bench); }

}  // namespace volumen
