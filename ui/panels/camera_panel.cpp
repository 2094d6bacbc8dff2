#include "ui/panels/camera_panel.h"

#include <QGridLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/workspace/camera_moves.h"

namespace volumen {

CameraPanel::CameraPanel(Session& session, std::function<Camera()> cameraInUse, QWidget* parent)
    : QWidget(parent), session_(session), cameraInUse_(std::move(cameraInUse)) {
  projection_ = new QComboBox;
  projection_->setObjectName(QStringLiteral("projection"));
  projection_->setAccessibleName(tr("Projection"));
  projection_->addItems({tr("Parallel"), tr("Perspective")});
  fov_ = new NumberRow(tr("Field of view"),
                       {.low = 5, .high = 120, .decimals = 0, .suffix = QStringLiteral("\u00b0")});
  auto* views = new QGridLayout;
  views->setSpacing(4);
  for (int n = 0; n < int(standardViewNames().size()); ++n) {
    const QString name = QString::fromStdString(standardViewNames()[n]);
    auto* button = new QPushButton(name.left(1).toUpper() + name.mid(1));
    button->setObjectName(QStringLiteral("camera-") + name);
    connect(button, &QPushButton::clicked, this, [this, name] { Q_EMIT viewRequested(name); });
    views->addWidget(button, n / 2, n % 2);
  }
  auto* reset = new QPushButton(tr("Reset view"));
  connect(reset, &QPushButton::clicked, this, &CameraPanel::resetRequested);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  column->addWidget(projection_);
  column->addWidget(fov_);
  column->addLayout(views);
  column->addWidget(reset);
  column->addStretch();

  connect(projection_, &QComboBox::activated, this, [this](int n) {
    edit(tr("Projection"), [n](Camera& camera) {
      camera = withProjection(camera, n == 0 ? Projection::parallel : Projection::perspective);
    });
    session_.endGesture();
  });
  connect(fov_, &NumberRow::valueEdited, this, [this](double degrees) {
    edit(tr("Field of view"), [degrees](Camera& camera) {
      // Converts via parallel projection, so that the size at the target stays the same.
      Camera parallel = withProjection(camera, Projection::parallel);
      parallel.fov = degrees;
      camera = withProjection(parallel, Projection::perspective);
    });
  });
  connect(fov_, &NumberRow::gestureFinished, this, [this] { session_.endGesture(); });
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.scene.camera != after.scene.camera || before.series != after.series) showCamera();
  });
  showCamera();
}

void CameraPanel::showCamera() {
  const Camera camera = session_.scene().camera.value_or(Camera{});
  projection_->setCurrentIndex(camera.projection == Projection::parallel ? 0 : 1);
  fov_->setValue(camera.fov);
  fov_->setEnabled(camera.projection == Projection::perspective);
  setEnabled(session_.series() != nullptr);
}

void CameraPanel::edit(const QString& what, const std::function<void(Camera&)>& change) {
  if (!session_.series()) return;
  Camera camera = cameraInUse_();
  change(camera);
  session_.edit(
      what, [&](Scene& s) { s.camera = camera; }, what);
}

}  // namespace volumen
