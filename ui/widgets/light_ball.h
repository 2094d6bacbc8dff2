#pragma once

#include <QImage>
#include <QWidget>
#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// A light on the ball.
struct BallLight {
  glm::dvec3 direction{0, 0, 1};  ///< unit, towards the light, camera space: x right, y up, z to the viewer
  glm::dvec3 colour{1};
  double intensity = 1;
  bool on = true;
  bool operator==(const BallLight&) const = default;
};

/// A shaded sphere seen from the camera, with a handle for each light, hollow for lights behind it. Dragging
/// a handle turns its light; beyond the rim it goes behind. Double-click or Space moves it to the other side,
/// arrows turn it (Shift: fine), Tab goes to the next light.
class LightBall : public QWidget {
  Q_OBJECT
 public:
  explicit LightBall(QWidget* parent = nullptr);

  void setLights(std::vector<BallLight> lights);
  const std::vector<BallLight>& lights() const { return lights_; }
  int selected() const { return selected_; }
  void select(int n);

  /// Returns the position of a direction in pixels.
  QPointF positionOf(glm::dvec3 direction) const;
  /// Returns the direction under a position; `behind` means the far side. Positions outside the rim are
  /// mirrored to the other side.
  glm::dvec3 directionAt(QPointF position, bool behind) const;

  QSize sizeHint() const override { return {150, 150}; }
  QSize minimumSizeHint() const override { return {84, 84}; }

 Q_SIGNALS:
  /// The user turned a light; the direction is a unit vector in camera space.
  void directionEdited(int n, glm::dvec3 direction);
  void gestureFinished();
  void selectionChanged(int n);

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void mouseDoubleClickEvent(QMouseEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void keyReleaseEvent(QKeyEvent*) override;
  bool event(QEvent*) override;

 private:
  QPointF centre() const;
  double radius() const;  // pixels
  int lightAt(QPointF position) const;
  void turn(int n, glm::dvec3 direction);
  void flip(int n);
  QImage shadedSphere() const;

  std::vector<BallLight> lights_;
  int selected_ = -1;
  bool dragging_ = false, dragBehind_ = false;
  QPointF grabOffset_;
  mutable QImage sphere_;  // drawn on demand
};

}  // namespace volumen
