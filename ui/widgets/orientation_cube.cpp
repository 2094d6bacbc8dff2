#include "ui/widgets/orientation_cube.h"

#include <QHBoxLayout>
#include <QMouseEvent>
#include <QPainter>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {
constexpr double cubeSize = 84;  // pixels, of the square in which the cube turns
constexpr double edge = 44;
}  // namespace

// A side of the patient (LPS): its view, letter, outward normal, and the up direction of its letter.
struct OrientationCube::Face {
  const char* view;
  const char* letter;
  glm::dvec3 out, up;
};

const OrientationCube::Face OrientationCube::faces[6] = {
    {"anterior", "A", {0, -1, 0}, {0, 0, 1}}, {"posterior", "P", {0, 1, 0}, {0, 0, 1}},
    {"left", "L", {1, 0, 0}, {0, 0, 1}},      {"right", "R", {-1, 0, 0}, {0, 0, 1}},
    {"superior", "S", {0, 0, 1}, {0, -1, 0}}, {"inferior", "I", {0, 0, -1}, {0, -1, 0}},
};

OrientationCube::OrientationCube(QWidget* parent) : QWidget(parent) {
  setFixedSize(132, int(cubeSize) + 26);
  setMouseTracking(true);
  setAccessibleName(tr("Orientation"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, int(cubeSize) + 4, 0, 0);
  row->setSpacing(0);
  for (const Face& face : faces) {
    auto* button = new QToolButton;
    const QString view = QString::fromLatin1(face.view);
    button->setText(QString::fromLatin1(face.letter));
    button->setObjectName(QStringLiteral("view-") + view);
    button->setProperty("onPicture", true);
    const QString name = tr("%1 view").arg(view.left(1).toUpper() + view.mid(1));
    button->setToolTip(toolTipOf(tr("%1 (%2)").arg(name, button->text())));
    button->setAccessibleName(name);
    button->setFixedSize(22, 22);
    button->setFocusPolicy(Qt::TabFocus);
    connect(button, &QToolButton::clicked, this, [this, view] { Q_EMIT viewRequested(view); });
    row->addWidget(button);
  }
}

void OrientationCube::setAxes(const CameraAxes& axes) {
  axes_ = axes;
  update();
}

bool OrientationCube::facesViewer(const Face& face) const {
  return glm::dot(face.out, axes_.direction) < -1e-3;
}

QPolygonF OrientationCube::outline(const Face& face) const {
  const glm::dvec3 right = glm::cross(face.up, face.out);
  QPolygonF polygon;
  for (const glm::dvec3& corner : {face.up - right, face.up + right, right - face.up, -face.up - right}) {
    const glm::dvec3 p = (face.out + corner) * (edge / 2);
    polygon << QPointF(width() / 2.0 + glm::dot(p, axes_.right), cubeSize / 2 - glm::dot(p, axes_.up));
  }
  return polygon;
}

QString OrientationCube::viewAt(QPointF position) const {
  for (const Face& face : faces)
    if (facesViewer(face) && outline(face).containsPoint(position, Qt::OddEvenFill))
      return QString::fromLatin1(face.view);
  return {};
}

void OrientationCube::mousePressEvent(QMouseEvent* event) {
  const QString view = viewAt(event->position());
  if (view.isEmpty() || event->button() != Qt::LeftButton) return event->ignore();
  Q_EMIT viewRequested(view);
}

void OrientationCube::mouseMoveEvent(QMouseEvent* event) {
  hovered_ = viewAt(event->position());
  update();
}

void OrientationCube::leaveEvent(QEvent*) {
  hovered_.clear();
  update();
}

void OrientationCube::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont letters = font();
  letters.setPixelSize(64);
  letters.setBold(true);
  painter.setFont(letters);
  const QPolygonF square(QRectF(0, 0, 100, 100));
  for (const Face& face : faces) {
    if (!facesViewer(face)) continue;
    const double light = -glm::dot(face.out, axes_.direction);
    const bool hovered = hovered_ == QLatin1String(face.view);
    const int grey = int(52 + 50 * light);
    painter.setBrush(hovered ? QColor(0x2b, 0x6c, 0xb0, 235) : QColor(grey, grey + 4, grey + 8, 225));
    painter.setPen(QPen(QColor(0xd7, 0xdc, 0xe2, 170), 1));
    const QPolygonF polygon = outline(face);
    painter.drawPolygon(polygon);
    QTransform onto;
    QPolygonF corners = square;
    corners.removeLast();  // QPolygonF(QRectF) is closed
    if (light < 0.15 || !QTransform::quadToQuad(corners, polygon, onto)) continue;
    painter.save();
    painter.setTransform(onto, true);
    painter.setPen(Qt::white);
    painter.drawText(QRectF(0, 0, 100, 100), Qt::AlignCenter, QString::fromLatin1(face.letter));
    painter.restore();
  }
}

}  // namespace volumen
