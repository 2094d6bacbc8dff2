#pragma once

#include <QPolygonF>
#include <QWidget>

#include "viewer/scene/scene.h"

namespace volumen {

/// A small cube that turns with the camera, its faces labelled A P L R S I, and a button for each letter
/// below. A click on either requests that view.
class OrientationCube : public QWidget {
  Q_OBJECT
 public:
  explicit OrientationCube(QWidget* parent = nullptr);

  void setAxes(const CameraAxes& axes);
  /// Returns the view of the face under a position; empty if there is none.
  QString viewAt(QPointF position) const;

 Q_SIGNALS:
  /// `view` is a name of standardView().
  void viewRequested(const QString& view);

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void leaveEvent(QEvent*) override;

 private:
  struct Face;
  QPolygonF outline(const Face& face) const;
  bool facesViewer(const Face& face) const;

  static const Face faces[6];
  CameraAxes axes_{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  QString hovered_;
};

}  // namespace volumen
