#include "ui/views/volume_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/views/canvas.h"
#include "ui/widgets/curve_edits.h"
#include "ui/widgets/orientation_cube.h"

namespace volumen {

namespace {
constexpr double turnPerPixel = 0.008;  // rad
glm::dvec2 toVec(QPointF p) { return {p.x(), p.y()}; }
}  // namespace

VolumeView::VolumeView(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      canvas_(makeCanvas([this](QPainter& p) { paint(p); }, [this] { replaceCanvas(); }, this)),
      cube_(new OrientationCube(this)) {
  setObjectName(QStringLiteral("volumeView"));
  setAccessibleName(tr("Volume view"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(200, 200);
  wheelEnd_.setSingleShot(true);
  wheelEnd_.setInterval(500);
  connect(&wheelEnd_, &QTimer::timeout, this, [this] { session_.endGesture(); });
  connect(cube_, &OrientationCube::viewRequested, this, &VolumeView::showView);
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (!areOneSeries(before.series, after.series)) setPicture({}, {});
    if (before.series != after.series || before.scene.camera != after.scene.camera) showState();
  });
  showState();
}

void VolumeView::showState() {
  const bool directions = session_.series() && session_.series()->volume->geometry().calibrated;
  cube_->setVisible(directions);
  if (session_.series()) cube_->setAxes(cameraAxes(camera()));
  canvas_->update();
}

void VolumeView::replaceCanvas() {
  canvas_->deleteLater();
  canvas_ = makeRasterCanvas([this](QPainter& p) { paint(p); }, this);
  canvas_->lower();
  canvas_->show();
  placeChildren();
}

void VolumeView::placeChildren() {
  canvas_->setGeometry(rect());
  cube_->move(8, height() - cube_->height() - 8);
}

const QImage& VolumeView::shown() const {
  return errorShown_ && !errorImage_.image.isNull() ? errorImage_.image : picture_;
}

void VolumeView::setErrorShown(bool shown) {
  errorShown_ = shown;
  makeErrorImage();
  canvas_->update();
}

void VolumeView::makeErrorImage() {
  errorImage_ = {};
  if (!errorShown_) return;
  errorImage_ = errorImage(error_ ? *error_ : std::vector<float>(), picture_.size());
  errorImage_.image.setDevicePixelRatio(picture_.devicePixelRatio());
}

void VolumeView::setPicture(const QImage& image, const QString& caption,
                            std::shared_ptr<const std::vector<float>> error) {
  picture_ = image;
  picture_.setDevicePixelRatio(devicePixelRatioF());
  caption_ = caption;
  error_ = std::move(error);
  makeErrorImage();
  canvas_->update();
}

void VolumeView::setTool(ViewTool tool) {
  tool_ = tool;
  setCursor(tool == ViewTool::curve ? Qt::SizeAllCursor : Qt::ArrowCursor);
}

QSize VolumeView::pixels() const {
  return {int(std::ceil(width() * devicePixelRatioF())), int(std::ceil(height() * devicePixelRatioF()))};
}

Camera VolumeView::camera() const {
  return cameraInUse(session_.scene(), session_.series()->volume->geometry(), size());
}

std::optional<Pick> VolumeView::pickAt(QPointF position) const {
  if (!session_.series()) return {};
  const Camera seen = camera();
  return pick(session_.scene(), *session_.series()->volume, sightLine(seen, size(), toVec(position)),
              seen.projection == Projection::parallel);
}

void VolumeView::editCamera(const QString& what, const Camera& camera) {
  session_.edit(
      what, [&](Scene& s) { s.camera = camera; }, what);
}

void VolumeView::showView(const QString& name) {
  if (!session_.series()) return;
  Camera view = *standardView(name.toStdString());
  const Camera now = camera();
  view.fov = now.fov;
  view.projection = now.projection;
  session_.endGesture();
  editCamera(tr("View from %1").arg(name),
             fitCamera(view, session_.series()->volume->geometry(), double(width()) / height()));
  session_.endGesture();
}

void VolumeView::resetView() {
  session_.edit(tr("Reset the view"), [](Scene& s) { s.camera.reset(); });
}

VolumeView::Hand VolumeView::handFor(const QMouseEvent& event) const {
  const bool control = event.modifiers() & Qt::ControlModifier, shift = event.modifiers() & Qt::ShiftModifier;
  switch (event.button()) {
    case Qt::MiddleButton:
      return Hand::pan;
    case Qt::RightButton:
      return Hand::zoom;
    case Qt::LeftButton:
      break;
    default:
      return Hand::none;
  }
  if (shift) return Hand::pan;
  if (tool_ == ViewTool::curve) return control ? Hand::opacity : Hand::curve;
  return control ? Hand::roll : Hand::orbit;
}

void VolumeView::mousePressEvent(QMouseEvent* event) {
  if (!session_.series() || hand_ != Hand::none) return;
  hand_ = handFor(*event);
  pressedAt_ = event->position();
  cameraAtPress_ = camera();
  curveAtPress_ = session_.scene().transferFunction;
  const std::optional<Pick> hit = pickAt(pressedAt_);
  pivot_ = hit ? hit->pPatient : *cameraAtPress_.target;
  if (!hit && hand_ == Hand::zoom && cameraAtPress_.projection == Projection::parallel)
    pivot_ = sightLine(cameraAtPress_, size(), toVec(pressedAt_)).origin;
  session_.endGesture();
}

Camera VolumeView::movedCamera(QPointF to) const {
  const QPointF moved = to - pressedAt_;
  switch (hand_) {
    case Hand::orbit:
      return orbited(cameraAtPress_, pivot_, moved.x() * turnPerPixel, moved.y() * turnPerPixel);
    case Hand::roll: {
      const QPointF middle(width() / 2.0, height() / 2.0), a = pressedAt_ - middle, b = to - middle;
      return rolled(cameraAtPress_, std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x()));
    }
    case Hand::pan:
      return panned(cameraAtPress_, size(), toVec(moved), pivot_);
    case Hand::zoom:
      return zoomedAt(cameraAtPress_, pivot_, std::exp(moved.y() * 0.008));
    default:
      return cameraAtPress_;
  }
}

TransferFunction VolumeView::movedCurve(QPointF to) const {
  const QPointF part((to.x() - pressedAt_.x()) / width(), (to.y() - pressedAt_.y()) / height());
  if (hand_ == Hand::opacity) return withOpacityScaled(curveAtPress_, std::exp(-6 * part.y()));
  const Histogram& histogram = session_.series()->histogram;
  return shifted(widened(curveAtPress_, std::exp(2 * part.x())),
                 part.y() * 0.5 * (histogram.high - histogram.low));
}

void VolumeView::mouseMoveEvent(QMouseEvent* event) {
  switch (hand_) {
    case Hand::none:
      return Q_EMIT hovered(hoverText(event->position()));
    case Hand::curve:
    case Hand::opacity: {
      const QString what = hand_ == Hand::curve ? tr("Shift the curve") : tr("Change overall opacity");
      return session_.edit(
          what, [&](Scene& s) { s.transferFunction = movedCurve(event->position()); }, what);
    }
    case Hand::orbit:
    case Hand::roll:
      return editCamera(tr("Turn the view"), movedCamera(event->position()));
    case Hand::pan:
      return editCamera(tr("Move the view"), movedCamera(event->position()));
    case Hand::zoom:
      return editCamera(tr("Zoom"), movedCamera(event->position()));
  }
}

void VolumeView::mouseReleaseEvent(QMouseEvent*) {
  hand_ = Hand::none;
  session_.endGesture();
}

void VolumeView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) Q_EMIT maximiseRequested();
}

void VolumeView::wheelEvent(QWheelEvent* event) {
  if (!session_.series() || hand_ != Hand::none) return;
  const Camera now = camera();
  const std::optional<Pick> hit = pickAt(event->position());
  const SightLine line = sightLine(now, size(), toVec(event->position()));
  glm::dvec3 fixed = hit ? hit->pPatient : line.origin;
  if (!hit && now.projection == Projection::perspective) fixed = line.origin + now.distance * line.direction;
  editCamera(tr("Zoom"), zoomedAt(now, fixed, std::pow(0.85, event->angleDelta().y() / 120.0)));
  wheelEnd_.start();
}

void VolumeView::keyPressEvent(QKeyEvent* event) {
  const int right = (event->key() == Qt::Key_Right) - (event->key() == Qt::Key_Left);
  const int down = (event->key() == Qt::Key_Down) - (event->key() == Qt::Key_Up);
  if (!session_.series() || (right == 0 && down == 0)) return QWidget::keyPressEvent(event);
  const double angle = (event->modifiers() & Qt::ShiftModifier ? 1 : 5) * 3.14159265358979 / 180;
  const Camera now = camera();
  editCamera(tr("Turn the view"), orbited(now, *now.target, right * angle, down * angle));
  if (!event->isAutoRepeat()) session_.endGesture();
}

void VolumeView::leaveEvent(QEvent*) { Q_EMIT hovered({}); }

void VolumeView::resizeEvent(QResizeEvent*) {
  placeChildren();
  showState();
  Q_EMIT pixelsChanged();
}

}  // namespace volumen
