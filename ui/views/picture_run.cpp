#include "ui/views/picture_run.h"

#include <QCoreApplication>
#include <QPainter>
#include <QResizeEvent>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "ui/data/frame_series.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/workspace/links.h"
#include "ui/workspace/text.h"

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

// Returns PictureStop::held from the series in a session's memory.
std::map<SeriesKey, LoadedSeriesPtr> seriesHeld(const PictureStop& stop, const Session& session) {
  std::map<SeriesKey, LoadedSeriesPtr> held;
  for (const SeriesKey& key : seriesSeen(stop)) {
    const auto state = stop.workspace.series.find(key);
    if (state == stop.workspace.series.end()) continue;
    if (LoadedSeriesPtr series = session.seriesWith(key, state->second.mask)) held[key] = std::move(series);
  }
  return held;
}

// Returns a session with what the view of a stop needs.
std::unique_ptr<Session> sessionOf(const PictureStop& stop, PictureLook::Size size, const Session& session) {
  auto copy = std::make_unique<Session>();
  copy->prefer(stop.preferences.value_or(session.preferences()));
  copy->pool().setBudget(std::numeric_limits<std::size_t>::max());
  for (const auto& [key, held] : stop.held.empty() ? seriesHeld(stop, session) : stop.held)
    copy->pool().put({key, stop.workspace.series.at(key).mask}, held);
  copy->open({}, workspaceOf(stop, size));
  return copy;
}

}  // namespace

PictureStop heldNow(PictureStop stop, const Session& session) {
  stop.held = seriesHeld(stop, session);
  stop.preferences = session.preferences();
  return stop;
}

PictureRun::PictureRun(const ViewGrid& grid, const Session& session, Jobs& jobs, const QString& doing,
                       std::vector<PictureStop> stops, const PictureLook& look, QObject* parent)
    : QObject(parent),
      grid_(grid),
      shown_(grid.shown()),
      session_(session),
      jobs_(jobs),
      job_(JobName(doing)),
      stops_(std::move(stops)),
      look_(look) {
  numbersSoon_.setSingleShot(true);
  numbersSoon_.setInterval(waitMs);
  connect(&numbersSoon_, &QTimer::timeout, this, &PictureRun::waitForNumbers);
  // Runs after the view has received the frame as well.
  connect(&frames_, &FrameService::ready, this,
          [this] { QTimer::singleShot(0, this, &PictureRun::prepare); });
  connect(&frames_, &FrameService::failed, this,
          [this](int, const FrameKey&, const QString& sentence) { end(shownText(sentence.toStdString())); });
}

PictureRun::~PictureRun() { jobs_.remove(job_); }

void PictureRun::start(Keep keep, Finish finish) {
  keep_ = std::move(keep);
  finish_ = std::move(finish);
  jobs_.add(job_, [this] { end(tr("Interrupted; nothing was written.")); });
  job_.tell({}, 0);
  QTimer::singleShot(0, this, &PictureRun::next);
}

void PictureRun::next() {
  if (hasEnded_) return;
  if (at_ < stops_.size())
    showStop();
  else
    finish();
}

void PictureRun::finish() {
  jobs_.remove(job_);
  jobs_.add(job_, {}, false);
  lane_.run(
      {}, [finish = finish_](const Job&) { return finish ? finish() : Status(); },
      [this](const Status& finished) {
        end(finished ? QString() : QString::fromStdString(finished.message()));
      });
}

void PictureRun::showStop() {
  const PictureStop& stop = stops_[at_];
  view_.reset();
  measurer_.reset();
  copy_ = sessionOf(stop, look_.size, session_);
  measurer_ = std::make_unique<MeasuredNumbers>(*copy_, frames_);
  view_ = grid_.unseenView(*copy_, frames_, *measurer_, stop.view, shown_);
  isPrepared_ = false;
  if (!view_) return end(tr("Only slices and frames can be made into such pictures."));
  resizeView(look_.seen);
  const ViewState& state = view_->state();
  const Series* series = seriesIn(copy_->workspace(), stop.view);
  if (!series) return end(tr("Open a series first."));
  if (!showsFrames(state.kind)) return prepare();
  const FlatLook look = flatLookOf(state);
  const int last = std::max(0, frameCount(*series) - 1);
  frames_.request(stop.view, copy_->workspace().series.at(state.series).series, std::min(look.frame, last), 1,
                  look.presentation.path);
}

// Sets the size of the picture once its content is known.
void PictureRun::prepare() {
  if (hasEnded_ || isPrepared_) return;
  if (!view_->shown()) {
    if (showsFrames(view_->state().kind)) return;  // waits for the frame
    return end(tr("The series is still being loaded: try again once it is shown."));
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
void PictureRun::resizeView(QSize logical) {
  const QSize before = view_->size();
  view_->resize(logical);
  QResizeEvent event(logical, before);
  QCoreApplication::sendEvent(view_.get(), &event);
}

// Sizes texts as on a screen.
void PictureRun::layOutForPaper() {
  resizeView((look_.mm * textsPerMm).toSize().expandedTo({1, 1}));
  view_->zoomTo(look_.mm.width() / view_->pixels().width());
}

// Waits without a limit; the user may cancel.
void PictureRun::waitForNumbers() {
  if (hasEnded_) return;
  if (look_.withTexts && !view_->isMeasured()) return numbersSoon_.start();
  draw();
}

QSize PictureRun::pixelsWanted() const {
  if (look_.size == Size::asSeen) return view_->pixels();
  if (look_.size == Size::paper)  // no higher resolution than that
    return QSize(int(look_.mm.width() * dotsPerMm), int(look_.mm.height() * dotsPerMm)).expandedTo({1, 1});
  const QSizeF from = look_.size == Size::wide ? QSizeF(view_->pixels()) : QSizeF(view_->ownPixels());
  const double edge = look_.size == Size::wide ? from.width() : std::max(from.width(), from.height());
  return (from * (look_.edge / edge)).toSize().expandedTo({1, 1});
}

void PictureRun::draw() {
  const std::optional<SliceRequest> request =
      look_.size == Size::own ? view_->requestForOwnPixels() : view_->requestFor(pixelsWanted());
  lane_.run(
      {},
      [request](const Job&) -> Result<QImage> {
        Result<QImage> drawn = drawSlice(*request);
        if (!drawn) return drawn;
        return (*std::move(drawn)).convertToFormat(QImage::Format_RGB32);
      },
      [this, mm = request->plane.mmPerPixel](Result<QImage> drawn) {
        if (!drawn) return end(QString::fromStdString(drawn.message()));
        keepPicture(*std::move(drawn), mm);
      });
}

void PictureRun::keepPicture(QImage picture, double mmPerPixel) {
  const HidingNames hiding(look_.namesHidden);
  MadePicture made;
  made.image = look_.withTexts ? view_->captureWith(std::move(picture)) : std::move(picture);
  made.image.setDevicePixelRatio(1);
  made.overlays = view_->overlays();
  made.warnings = static_cast<View&>(*view_).warningsShown();
  made.lengthsWord = view_->lengthsWord();
  if (made.overlays.mmPerPixel > 0) made.mmPerPixel = mmPerPixel;
  lane_.run(
      {}, [keep = keep_, n = at_, made](const Job&) { return keep(n, made); },
      [this](const Status& kept) { take(kept); });
}

void PictureRun::take(const Status& kept) {
  if (!kept) return end(QString::fromStdString(kept.message()));
  ++at_;
  job_.tell(tr("%1: %2 of %3").arg(job_.name().doing).arg(at_).arg(stops_.size()),
            double(at_) / double(stops_.size()));
  next();
}

void PictureRun::end(const QString& failure) {
  if (std::exchange(hasEnded_, true)) return;
  numbersSoon_.stop();
  lane_.giveUpAll();
  jobs_.remove(job_);
  Q_EMIT ended(failure);
  lane_.run(
      {}, [](const Job&) {}, [this] { deleteLater(); });  // after the current drawing
}

}  // namespace volumen
