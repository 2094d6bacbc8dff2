#include "ui/exports/flat_pictures.h"

#include <QCoreApplication>
#include <QResizeEvent>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "ui/controller/loader.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/links.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

constexpr int waitMs = 20;             // interval for results of measurements
constexpr double textEdge = 640;       // logical pixels of a whole picture for which texts are sized
constexpr double textsPerMm = 3.7795;  // logical pixels of a 96 dpi screen
constexpr double dotsPerMm = 11.811;   // 300 dpi on paper

// Shows the whole picture or the visible part; nothing is selected.
Workspace workspaceOf(const PictureStop& stop, PictureLook::Size size) {
  Workspace workspace = stop.workspace;
  workspace.selected = 0;
  if (size != PictureLook::Size::own && size != PictureLook::Size::whole) return workspace;
  ViewState& view = workspace.editView(stop.view);
  FlatLook& look = view.flats.editOrAdd(view.series);
  look.zoom = 1;
  look.panMm = {};
  return workspace;
}

// Returns the series the stop shows and those measured over it.
std::set<SeriesKey> seriesSeen(const PictureStop& stop) {
  const ViewState& view = stop.workspace.view(stop.view);
  std::set<SeriesKey> seen{view.series, flatLookOf(view).overlay};
  for (const Measurement& m : stop.workspace.measurements) {
    seen.insert(m.series);
    if (const auto over = seriesOver(stop.workspace, m.series)) seen.insert(over->series);
  }
  return seen;
}

// Returns the series of a view of slices if it is a time point that is not in memory, else null.
std::shared_ptr<const Series> timePointToRead(const PictureStop& stop) {
  const ViewState& view = stop.workspace.view(stop.view);
  if (showsFrames(view.kind) || stop.held.contains(view.series)) return nullptr;
  if (!hasTimePoints(stop.workspace, view.series)) return nullptr;
  const SeriesState& state = stop.workspace.series.at(view.series);
  return state.mask.empty() ? state.series : nullptr;
}

class FlatPictures : public QObject, public PictureMaker {
 public:
  FlatPictures(const ViewGrid& grid, std::vector<PictureStop> stops, const PictureLook& look);

  std::size_t count() const override { return stops_.size(); }
  void make(std::size_t n, JobLane& lane, const Done& done) override;

 private:
  using Size = PictureLook::Size;

  void show(PictureStop stop);
  void prepare();
  void waitForNumbers();
  void draw();
  MadePicture madeOf(QImage picture, double mmPerPixel) const;
  void answer(const Result<MadePicture>& made);
  QSize pixelsWanted() const;
  void resizeView(QSize logical);
  void layOutForPaper();

  const ViewGrid& grid_;
  const Highlights highlights_;
  const std::vector<PictureStop> stops_;
  const PictureLook look_;
  std::size_t at_ = 0;
  JobLane* lane_ = nullptr;
  Done done_;  // empty while no picture is being made
  FrameService frames_;
  std::unique_ptr<Session> copy_;  // with the workspace of the stop
  std::unique_ptr<MeasuredNumbers> measurer_;
  std::unique_ptr<FlatView> view_;  // over copy_ and measurer_
  QTimer numbersSoon_;
  bool isPrepared_ = false;  // whether the content of the stop is known
};

FlatPictures::FlatPictures(const ViewGrid& grid, std::vector<PictureStop> stops, const PictureLook& look)
    : grid_(grid), highlights_(grid.highlights()), stops_(std::move(stops)), look_(look) {
  numbersSoon_.setSingleShot(true);
  numbersSoon_.setInterval(waitMs);
  connect(&numbersSoon_, &QTimer::timeout, this, &FlatPictures::waitForNumbers);
  // Runs after the view has received the frame as well.
  connect(&frames_, &FrameService::ready, this,
          [this] { QTimer::singleShot(0, this, &FlatPictures::prepare); });
  connect(&frames_, &FrameService::failed, this, [this](int, const FrameKey&, const QString& sentence) {
    answer(Error{shownText(sentence.toStdString()).toStdString()});
  });
}

void FlatPictures::answer(const Result<MadePicture>& made) {
  numbersSoon_.stop();
  if (const Done done = std::exchange(done_, {})) done(made);
}

void FlatPictures::make(std::size_t n, JobLane& lane, const Done& done) {
  at_ = n, lane_ = &lane, done_ = done;
  const PictureStop& stop = stops_[at_];
  const std::shared_ptr<const Series> step = timePointToRead(stop);
  if (!step) return show(stop);
  lane.run(
      {}, [step](const Job& job) { return loadForSlices(*step, job); },
      [this](const Result<LoadedSeriesPtr>& read) {
        if (!read) return answer(read.error());
        PictureStop now = stops_[at_];
        now.held[keyOf((*read)->series)] = *read;
        show(std::move(now));
      });
}

void FlatPictures::show(PictureStop stop) {
  view_.reset();
  measurer_.reset();
  stop.workspace = workspaceOf(stop, look_.size);
  copy_ = sessionOf(stop);
  measurer_ = std::make_unique<MeasuredNumbers>(*copy_, frames_);
  view_ = grid_.unseenView(*copy_, frames_, *measurer_, stop.view, highlights_);
  isPrepared_ = false;
  if (!view_)
    return answer(Error{tr("Only slices and frames can be made into such pictures.").toStdString()});
  resizeView(look_.seen);
  const ViewState& state = view_->state();
  const Series* series = seriesIn(copy_->workspace(), stop.view);
  if (!series) return answer(Error{tr("Open a series first.").toStdString()});
  if (!showsFrames(state.kind)) return prepare();
  const FlatLook look = flatLookOf(state);
  const int last = std::max(0, frameCount(*series) - 1);
  frames_.request(stop.view, copy_->workspace().series.at(state.series).series, std::min(look.frame, last), 1,
                  look.presentation.path);
}

// Sets the size of the picture once its content is known.
void FlatPictures::prepare() {
  if (!done_ || isPrepared_) return;
  if (!view_->shown()) {
    if (showsFrames(view_->state().kind)) return;  // waits for the frame
    return answer(Error{tr("The series is still being loaded: try again once it is shown.").toStdString()});
  }
  isPrepared_ = true;
  if (look_.size == Size::own || look_.size == Size::whole) {
    const QSizeF own = view_->ownPixels();
    const double shorter = std::min(own.width(), own.height()), longer = std::max(own.width(), own.height());
    const double scale =
        look_.size == Size::whole ? textEdge / longer : 1 / std::max(1.0, shorter / textEdge);
    resizeView((own * scale / view_->devicePixelRatioF()).toSize().expandedTo({1, 1}));
  }
  if (look_.size == Size::paper) layOutForPaper();
  waitForNumbers();
}

// A hidden widget learns its size only when it is shown.
void FlatPictures::resizeView(QSize logical) {
  const QSize before = view_->size();
  view_->resize(logical);
  QResizeEvent event(logical, before);
  QCoreApplication::sendEvent(view_.get(), &event);
}

// Sizes texts as on a screen.
void FlatPictures::layOutForPaper() {
  resizeView((look_.mm * textsPerMm).toSize().expandedTo({1, 1}));
  view_->zoomTo(look_.mm.width() / view_->pixels().width());
}

// Waits without a limit; the user may cancel.
void FlatPictures::waitForNumbers() {
  if (!done_) return;
  if (look_.withTexts && !view_->isMeasured()) return numbersSoon_.start();
  draw();
}

QSize FlatPictures::pixelsWanted() const {
  if (look_.size == Size::asSeen) return view_->pixels();
  if (look_.size == Size::paper)  // no higher resolution than that
    return QSize(int(look_.mm.width() * dotsPerMm), int(look_.mm.height() * dotsPerMm)).expandedTo({1, 1});
  const QSizeF from = look_.size == Size::wide ? QSizeF(view_->pixels()) : QSizeF(view_->ownPixels());
  const double edge = look_.size == Size::wide ? from.width() : std::max(from.width(), from.height());
  return (from * (look_.edge / edge)).toSize().expandedTo({1, 1});
}

void FlatPictures::draw() {
  const std::optional<SliceRequest> request =
      look_.size == Size::own ? view_->requestForOwnPixels() : view_->requestFor(pixelsWanted());
  lane_->run(
      {},
      [request](const Job&) -> Result<QImage> {
        Result<QImage> drawn = drawSlice(*request);
        if (!drawn) return drawn;
        return (*std::move(drawn)).convertToFormat(QImage::Format_RGB32);
      },
      [this, mm = request->plane.mmPerPixel](Result<QImage> drawn) {
        answer(drawn ? Result(madeOf(*std::move(drawn), mm)) : drawn.error());
      });
}

MadePicture FlatPictures::madeOf(QImage picture, double mmPerPixel) const {
  const HidingNames hiding(look_.namesHidden);
  MadePicture made;
  made.image = look_.withTexts ? view_->captureWith(std::move(picture)) : std::move(picture);
  made.image.setDevicePixelRatio(1);
  made.text = plainPictureText(static_cast<View&>(*view_).warningsShown());
  made.label = stops_[at_].label;
  made.overlays = view_->overlays();
  if (made.overlays.mmPerPixel > 0) made.mmPerPixel = mmPerPixel;
  return made;
}

}  // namespace

PictureStop heldNow(PictureStop stop, const Session& session) {
  stop.preferences = session.preferences();
  for (const SeriesKey& key : seriesSeen(stop)) {
    const auto state = stop.workspace.series.find(key);
    if (state == stop.workspace.series.end()) continue;
    if (LoadedSeriesPtr series = session.seriesWith(key, state->second.mask))
      stop.held[key] = std::move(series);
  }
  return stop;
}

std::unique_ptr<Session> sessionOf(const PictureStop& stop) {
  const HidingNames asOnScreen(namesHidden());  // prefer() sets it for the whole program
  auto copy = std::make_unique<Session>();
  copy->prefer(stop.preferences);
  copy->pool().setBudget(std::numeric_limits<std::size_t>::max());
  for (const auto& [key, held] : stop.held) copy->pool().put({key, stop.workspace.series.at(key).mask}, held);
  copy->open({}, stop.workspace);
  return copy;
}

PictureMakerPtr flatPictures(const ViewGrid& grid, std::vector<PictureStop> stops, const PictureLook& look) {
  return std::make_shared<FlatPictures>(grid, std::move(stops), look);
}

}  // namespace volumen
