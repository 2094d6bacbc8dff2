#pragma once

#include <QImage>
#include <QTimer>
#include <memory>
#include <optional>

#include "ui/controller/slice_service.h"
#include "ui/tools/flat_tool.h"
#include "ui/views/overlays.h"
#include "ui/views/view.h"

namespace volumen {

class Measurer;
class WarningBadge;
struct DrawnMeasurement;

/// A plane through the volume of a series, whole at every step: the left button as the tool says, the wheel
/// scrolls, Ctrl+wheel zooms, Alt+wheel makes the slab thicker, Shift+move moves the crosshair everywhere.
class SliceView : public View {
  Q_OBJECT
 public:
  SliceView(Session& session, SliceService& service, Measurer& measurer, ViewId id,
            QWidget* parent = nullptr);

  const QImage& picture() const { return picture_; }
  /// The plane on screen, device pixels; none without a series.
  std::optional<SlicePlane> plane() const;
  void setTool(const FlatTool& tool);
  /// So many slices down the patient.
  void scroll(int steps);
  /// Whole again, and thin.
  void resetView();
  /// The measurements that are seen, the one that is being drawn last.
  std::vector<DrawnMeasurement> drawnMeasurements() const;

 Q_SIGNALS:
  /// The picture of what the workspace says is on screen.
  void settled();
  /// The key of a tool was pressed.
  void toolWanted(const volumen::FlatTool& tool);
  /// A measurement was drawn, and no other is wanted.
  void toolDone();

 protected:
  void seriesExchanged(bool another) override;
  void workspaceChanged(const Workspace& before) override;
  void paintEvent(QPaintEvent*) override;
  void showEvent(QShowEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void wheelEvent(QWheelEvent*) override;
  void mouseDoubleClickEvent(QMouseEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  bool event(QEvent*) override;
  void leaveEvent(QEvent*) override;

 private:
  std::optional<FlatPress> pressAt(QPointF p) const;
  const FlatTool* toolFor(const QMouseEvent& event) const;
  GreyMapping grey() const;
  void askForPicture();
  void showPicture(const SlicePicture& picture);
  void chooseWindow(int number);
  void makeSlabThicker(int steps);
  void placeBadge();
  QString hoverText(QPointF position) const;
  Overlays overlays() const;
  QRectF overlayArea() const { return QRectF(rect()).adjusted(0, 0, -6, 0); }
  void paintLines(QPainter& painter) const;
  void paintStackBar(QPainter& painter) const;
  std::optional<MeasurementHit> measurementAt(QPointF p) const;
  std::unique_ptr<Drag> pressMeasurement(const FlatPress& press);
  void endDrag(Qt::KeyboardModifiers keys);
  void askForName(int id);
  QString measurementText(QPointF p) const;
  void showCursorAt(QPointF p);
  bool pressMeasuringKey(const QKeyEvent& event);

  SliceService& service_;
  Measurer& measurer_;
  WarningBadge* badge_;
  const FlatTool* tool_;
  QImage picture_;
  std::optional<SliceRequest> asked_;  // the last
  std::unique_ptr<Drag> drag_;
  int stepsAtPress_ = 0;  // of the undo stack
  QTimer wheelEnd_;
  double wheelRest_ = 0;  // notches not yet scrolled
};

}  // namespace volumen
