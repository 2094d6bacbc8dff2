#include "ui/views/first_image.h"

#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "io/study/frame_series.h"
#include "results/pictures/overlays.h"
#include "ui/controller/frame_service.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/frame_look.h"

namespace volumen {

FirstImage::FirstImage(FrameService& frames, SliceService& slices, QWidget* parent)
    : QWidget(parent), frames_(frames), slices_(slices) {
  setObjectName(QStringLiteral("firstImage"));
  setAccessibleName(tr("First image of what is being loaded"));
  setAttribute(Qt::WA_OpaquePaintEvent);
  hide();
  connect(&frames_, &FrameService::ready, this, &FirstImage::takeFrame);
  connect(&slices_, &SliceService::ready, this, &FirstImage::takePicture);
}

int FirstImage::count() const { return shown_ ? frameCount(*shown_) : 0; }

std::string FirstImage::sopInstanceUid() const {
  return shown_ && std::size_t(index()) < shown_->sopInstanceUids.size()
             ? shown_->sopInstanceUids[std::size_t(index())]
             : std::string();
}

void FirstImage::begin(const SeriesState& state, bool isPart) {
  end();
  const int count = frameCount(*state.series);
  if (count == 0) return;
  state_ = state;
  series_ = state.series;
  isPart_ = isPart;
  go(count / 2, 1);
}

void FirstImage::goOn(const SeriesState& state, bool isPart) {
  if (!series_) return;
  const auto imageAt = [](const Series& series, std::size_t index) {
    return std::pair(index < series.sopInstanceUids.size() ? series.sopInstanceUids[index] : std::string(),
                     index < series.frames.size() ? series.frames[index] : 0);
  };
  const auto image = imageAt(*series_, std::size_t(wanted_));
  const int count = frameCount(*state.series);
  int index = 0;
  while (index < count && imageAt(*state.series, std::size_t(index)) != image) ++index;
  state_ = state;
  series_ = state.series;
  isPart_ = isPart;
  go(index < count ? index : std::clamp(wanted_, 0, count - 1), 1);
}

void FirstImage::end() {
  if (!series_) return;
  series_.reset();
  shown_.reset();
  frame_.reset();
  picture_ = {};
  frames_.drop(firstImageId);
  slices_.drop(firstImageId);
  hide();
}

void FirstImage::go(int index, int step) {
  wanted_ = index;
  frames_.request(firstImageId, series_, index, step);
  if (const LoadedFramePtr held = frames_.find({keyOf(*series_), index})) takeFrame(firstImageId, held);
}

void FirstImage::takeFrame(int view, const LoadedFramePtr& frame) {
  if (view != firstImageId || !series_ || frame->key != FrameKey{keyOf(*series_), wanted_}) return;
  const bool isFirst = !frame_;
  frame_ = frame;
  shown_ = series_;
  if (isFirst) Q_EMIT appears();
  askForPicture();
}

void FirstImage::askForPicture() {
  if (!frame_ || width() < 1 || height() < 1) return;
  ViewState view;
  view.kind = ViewKind::frames;
  view.series = frame_->key.series;
  const QSize size = this->size() * devicePixelRatioF();
  const SlicePlane plane =
      flatPlane(view, FlatLook(), frame_->geometry(), Crosshair(), {size.width(), size.height()});
  const SliceLayer layer{frame_->slice->volume, frameGrey(shownState(), FlatLook(), *frame_), state_.colours};
  slices_.request({firstImageId, {layer}, plane, frame_});
}

// Returns the state with the window the volume will have.
SeriesState FirstImage::shownState() const {
  SeriesState state = state_;
  const std::vector<NamedGrey>& greys = frame_->seriesGreys.empty() ? frame_->greys : frame_->seriesGreys;
  // If the values of the frame differ from the volume's, the frame's own mapping is the best choice.
  if (state.window || greys.empty() || frame_->slice->series.unit != series_->unit) return state;
  const NamedGrey& first = greys.front();
  const bool isWindow = !first.ofValues && first.mapping.table.grey.empty();
  state.window = windowToCome(*series_, isWindow ? std::optional(first.mapping.window) : std::nullopt);
  return state;
}

void FirstImage::takePicture(const SlicePicture& picture) {
  if (picture.request.view != firstImageId || !frame_ || picture.request.frame != frame_) return;
  picture_ = picture.image;
  picture_.setDevicePixelRatio(devicePixelRatioF());
  show();
  update();
}

void FirstImage::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Qt::black);
  if (!frame_) return;
  painter.drawImage(QPointF(0, 0), picture_);
  CornerTexts texts = seriesCorner(*shown_, index());
  const QString place = isPart_ ? tr("Image %1 / %2 so far, loading") : tr("Image %1 / %2, loading");
  texts.add(CornerItem::plane, place.arg(index() + 1).arg(count()));
  const int lines = cornerLines(rect(), font());
  Overlays o;
  o.topLeft = texts.left(lines);
  o.topRight = texts.right(lines);
  paintOverlays(painter, o, rect());
}

void FirstImage::resizeEvent(QResizeEvent*) { askForPicture(); }

void FirstImage::wheelEvent(QWheelEvent* event) {
  event->accept();
  if (!series_) return;
  wheelRest_ -= event->angleDelta().y() / 120.0;
  const int steps = int(std::trunc(wheelRest_));
  wheelRest_ -= steps;
  const int index = std::clamp(wanted_ + steps, 0, frameCount(*series_) - 1);
  if (index != wanted_) go(index, steps < 0 ? -1 : 1);
}

}  // namespace volumen
