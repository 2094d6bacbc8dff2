#pragma once

#include "ui/workspace/session.h"

class QWidget;

namespace volumen {

/// Functions of the 3D view whose camera the camera panel shows and sets.
struct CameraInView {
  std::function<Camera()> inUse;  ///< the camera, which may be fitted
  std::function<void(const QString& standardView)> show;
  std::function<void()> reset;
};

/// Makes the panel of the projection and the standard views.
QWidget* makeCameraPanel(Session& session, const CameraInView& view);
/// Makes the panel of the clip box: how much each of its six sides cuts from the volume.
QWidget* makeClipPanel(Session& session);
/// Makes the panel of the reflection of surfaces. Its numbers are disabled if the scene is unlit.
QWidget* makeMaterialPanel(Session& session);

}  // namespace volumen
