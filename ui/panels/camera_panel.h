#pragma once

#include <QComboBox>

#include "ui/widgets/number_row.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The projection and the standard views. `cameraInUse` returns the view's camera, which may be fitted.
class CameraPanel : public QWidget {
  Q_OBJECT
 public:
  CameraPanel(Session& session, std::function<Camera()> cameraInUse, QWidget* parent = nullptr);

 Q_SIGNALS:
  void viewRequested(const QString& view);
  void resetRequested();

 private:
  void showCamera();
  void edit(const QString& what, const std::function<void(Camera&)>& change);

  Session& session_;
  std::function<Camera()> cameraInUse_;
  QComboBox* projection_;
  NumberRow* fov_;
};

}  // namespace volumen
