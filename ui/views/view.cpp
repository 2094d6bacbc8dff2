#include "ui/views/view.h"

#include <QDragEnterEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <cmath>

#include "results/pictures/picture_font.h"
#include "results/series/time_points.h"
#include "ui/widgets/drop_mark.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/dragged_series.h"
#include "ui/workspace/layout_text.h"
#include "ui/workspace/priors.h"

namespace volumen {

namespace {

constexpr int momentMs = 300;  // delay before the loading mark

QLabel* makeLoadingMark(QWidget* parent) {
  auto* mark = plainLabel(View::tr("Loading"));
  mark->setParent(parent);
  mark->setObjectName(QStringLiteral("loadingMark"));
  // The colours are the same in both themes because the mark lies on the picture.
  mark->setStyleSheet(
      QStringLiteral("#loadingMark { color: #f2f4f6; background: rgba(27,30,34,210); border-radius: 3px; "
                     "padding: 2px 8px; }"));
  mark->setAttribute(Qt::WA_TransparentForMouseEvents);
  mark->adjustSize();
  mark->hide();
  return mark;
}

std::shared_ptr<const Series> knownSeries(const Workspace& workspace, const SeriesKey& key) {
  const auto known = workspace.series.find(key);
  return known == workspace.series.end() ? nullptr : known->second.series;
}

}  // namespace

View::View(Session& session, ViewId id, QWidget* parent)
    : QWidget(parent),
      session_(session),
      id_(id),
      seen_(series()),
      shownLast_(knownSeries(session.workspace(), state().series)),
      loading_(makeLoadingMark(this)),
      dropMark_(new DropMark(this)) {
  loadingSoon_.setSingleShot(true);
  loadingSoon_.setInterval(momentMs);
  connect(&loadingSoon_, &QTimer::timeout, this, [this] {
    loading_->raise();
    loading_->show();
  });
  setFont(pictureFont(session.preferences().textPercent));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAcceptDrops(true);
  session_.setViewSize(id_, {pixels().width(), pixels().height()});
  connect(&session_, &Session::workspaceChanged, this, [this](const Workspace& before) {
    const LoadedSeriesPtr last = std::exchange(seen_, series());
    const bool another = !followSeries();
    if (last != seen_ || another) seriesExchanged(another);
    showWaiting();
    workspaceChanged(before);
    tellPointed();
  });
  connect(&session_, &Session::preferencesChanged, this, [this] {
    setFont(pictureFont(session_.preferences().textPercent));
    update();
    tellPointed();
  });
  showWaiting();
}

// Returns whether the series is the same as before or another time point of it.
bool View::followSeries() {
  const std::shared_ptr<const Series> now = knownSeries(session_.workspace(), state().series);
  const std::shared_ptr<const Series> last = std::exchange(shownLast_, now);
  return last == now || (last && now && areTimePoints(*last, *now));
}

bool View::isWaiting() const {
  const auto known = session_.workspace().series.find(state().series);
  return !showsFrames(state().kind) && known != session_.workspace().series.end() && !known->second.missing &&
         givenUp_ != state().series && !series();
}

void View::giveUpWaiting(const SeriesKey& series) {
  if (!isWaiting() || state().series != series) return;
  givenUp_ = series;
  seriesExchanged(true);
  showWaiting();
  update();
}

void View::showWaiting() {
  if (givenUp_ != state().series || seen_) givenUp_ = {};
  if (isLoading()) {
    if (!loading_->isVisible() && !loadingSoon_.isActive()) loadingSoon_.start();
    return;
  }
  loadingSoon_.stop();
  loading_->hide();
  setPercentRead({});
}

void View::setPercentRead(std::optional<int> percent) {
  const QString text = percent ? tr("Loading %1 %").arg(*percent) : tr("Loading");
  if (text == loading_->text()) return;
  loading_->setText(text);
  loading_->adjustSize();
  placeLoading();
}

void View::placeLoading() { loading_->move((width() - loading_->width()) / 2, height() / 4); }

Overlays View::waitingOverlays() const {
  const Series& series = *seriesIn(session_.workspace(), id_);
  CornerTexts texts = seriesCorner(series);
  texts.add(CornerItem::step, stepText(session_.workspace(), state().series));
  const int lines = cornerLines(rect(), font());
  Overlays o;
  o.topLeft = texts.left(lines);
  o.topRight = texts.right(lines);
  return o;
}

QSize View::pixels() const {
  return {int(std::ceil(width() * devicePixelRatioF())), int(std::ceil(height() * devicePixelRatioF()))};
}

QImage View::capture() const {
  return captureBy(pixels(), [this](QPainter& painter) { paintShown(painter); });
}

QImage View::captureBy(QSize pixels, const std::function<void(QPainter&)>& paint) const {
  QImage image(pixels, QImage::Format_RGB32);
  image.fill(Qt::black);
  captureOver(image, paint);
  return image;
}

void View::captureOver(QImage& image, const std::function<void(QPainter&)>& paint) const {
  image.setDevicePixelRatio(devicePixelRatioF() * image.width() / pixels().width());
  QPainter painter(&image);
  painter.setFont(font());
  paint(painter);
  for (QWidget* badge : badges())
    if (badge->isVisibleTo(this)) badge->render(&painter, badge->pos(), {}, QWidget::DrawChildren);
}

void View::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paintShown(painter);
  paintFocus(painter);
}

QString View::dateBeside() const { return dateToTellApart(session_.workspace(), id_); }

void View::paintInvitation(QPainter& painter) const {
  if (!state().series.empty() || !comparesSeries(layoutOf(session_.workspace(), id_))) return;
  const QRect area = rect().adjusted(8, 8, -8, -8);
  painter.setFont(font());
  painter.setPen(QColor(0xd7, 0xdc, 0xe2));
  painter.drawText(area, Qt::AlignCenter | Qt::TextWordWrap, invitationText(state()));
}

void View::paintFocus(QPainter& painter) const {
  paintInvitation(painter);
  if (viewsOnScreen(session_.workspace()).size() < 2 || session_.workspace().focus != id_) return;
  painter.setPen(QColor(0x4a, 0xa3, 0xff));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

// The views of a group show one series together.
void View::showDropMark(bool on) {
  const bool together = id_ < firstComparedId && viewsInMain(session_.workspace()).size() > 1;
  if (on) dropMark_->tell(together ? tr("Show in these views") : tr("Show here"));
  dropMark_->setGeometry(rect());
  dropMark_->setVisible(on);
  dropMark_->raise();
}

// Files are dropped on the window.
void View::dragEnterEvent(QDragEnterEvent* event) {
  if (!event->mimeData()->hasFormat(draggedSeriesType)) return event->ignore();
  event->acceptProposedAction();
  showDropMark(true);
}

void View::dragLeaveEvent(QDragLeaveEvent*) { showDropMark(false); }

void View::dropEvent(QDropEvent* event) {
  showDropMark(false);
  if (!event->mimeData()->hasFormat(draggedSeriesType)) return event->ignore();
  event->acceptProposedAction();
  session_.setFocus(id_);
  Q_EMIT dropped(*event->mimeData());
}

void View::mousePressEvent(QMouseEvent* event) {
  session_.setFocus(id_);
  event->accept();
}

void View::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) Q_EMIT maximiseRequested();
}

// Handles the key itself, because only some systems send a context menu event with it.
void View::keyPressEvent(QKeyEvent* event) {
  const bool isMenuKey = event->key() == Qt::Key_Menu ||
                         (event->key() == Qt::Key_F10 && event->modifiers() == Qt::ShiftModifier);
  if (!isMenuKey || !hasMenu()) return QWidget::keyPressEvent(event);
  session_.setFocus(id_);
  Q_EMIT menuRequested(mapToGlobal(rect().center()));
}

// Tab came here from a panel. An activated window takes no focus: a press on a panel may have activated it,
// and panels refer to the view in focus.
void View::focusInEvent(QFocusEvent* event) {
  QWidget::focusInEvent(event);
  if (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason)
    session_.setFocus(id_);
}

void View::pointAt(QPointF position) {
  pointedAt_ = position;
  tellPointed();
}

void View::tellPointed() {
  if (pointedAt_) Q_EMIT hovered(textAt(*pointedAt_));
}

void View::leaveEvent(QEvent*) {
  pointedAt_.reset();
  Q_EMIT hovered({});
}

void View::hideEvent(QHideEvent*) {
  showDropMark(false);
  if (std::exchange(pointedAt_, {})) Q_EMIT hovered({});
}

void View::resizeEvent(QResizeEvent*) {
  placeLoading();
  dropMark_->setGeometry(rect());
  followPixels();
}

// Another screen may have another pixel ratio.
bool View::event(QEvent* event) {
  if (event->type() == QEvent::ScreenChangeInternal) followPixels();
  return QWidget::event(event);
}

void View::followPixels() {
  session_.setViewSize(id_, {pixels().width(), pixels().height()});
  Q_EMIT pixelsChanged();
  tellPointed();
}

}  // namespace volumen
