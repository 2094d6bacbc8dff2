#pragma once

#include <QListWidget>

#include "ui/widgets/bind.h"
#include "ui/widgets/light_ball.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Edits the lights: directions on a ball, a list to switch them, and colour, intensity and space of the
/// selected one.
class LightsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit LightsPanel(Session& session, QWidget* parent = nullptr);
  LightBall* ball() const { return ball_; }

 private:
  QWidget* makeList();
  void makeFields();
  void connectBall();
  void showLights();
  void showSelected();
  void changeSelected(const QString& what, const std::function<void(Light&)>& change);
  void addLight();
  void removeLight();
  CameraAxes axes() const;

  Session& session_;
  LightBall* ball_;
  QListWidget* list_;
  QToolButton *add_, *remove_;
  QWidget* fields_;
  std::vector<Follower<Light>> followers_;  // fields of the selected light
};

}  // namespace volumen
