#pragma once

#include <QImage>
#include <QTimer>
#include <map>

#include "ui/controller/draw_service.h"
#include "ui/controller/slice_image.h"
#include "ui/overlays/overlays.h"
#include "ui/tools/tool.h"
#include "ui/views/drawn_measurement.h"
#include "ui/views/error_image.h"
#include "ui/views/pick.h"
#include "ui/views/view.h"

class QToolButton;

namespace volumen {

class CineBar;
class OrientationCube;
class WarningBadge;

/// The picture of the session's scene at device pixels, and what the mouse does with it: left-drag as the
/// tool says, the other drags and the wheel as they are bound (ui/tools/mouse_bindings), a pinch zooms,
/// arrows turn, double-click asks to be alone.
class VolumeView : public View {
  Q_OBJECT
 public:
  VolumeView(Session& session, DrawService& drawService, ViewId id = sceneViewId, QWidget* parent = nullptr);

  /// Asks for the picture again, as the service draws by now; while it is hidden, for none.
  void requestPicture();

  /// The picture drawn last, its name for the corner ("final: standard - 95 ms"), and how far its pixels may
  /// be off, null where that is not known.
  void setPicture(const QImage& image, const QString& caption,
                  std::shared_ptr<const std::vector<float>> error = {});
  const QImage& picture() const { return picture_; }
  /// Shows how far the picture's pixels may be off in its place, where that is known.
  void setErrorShown(bool shown);
  /// What is on show: the picture, or its error.
  const QImage& shown() const;
  /// Draws of a volume only the values of this range that the curve shows, whatever the scene says; none: the
  /// scene.
  void showOnly(const std::optional<VolumeRange>& range);
  void setTool(const Tool& tool);
  const Tool& tool() const { return *tool_; }
  /// The tool in hand in flat views: where it draws in 3D as well, the left button does that first.
  void setFlatTool(const Tool& tool);
  /// Whether the key of a tool that draws in 3D chooses it here: it does not where the window means something
  /// else by it.
  bool hasKey(const Tool& tool) const;
  /// The measurements that are seen, the one that is being drawn last. Points have handles where they were
  /// picked in 3D and are not hidden: others belong to their slices.
  std::vector<DrawnMeasurement> drawnMeasurements() const { return *placedMeasurements(); }
  /// The same list until something changes that it follows from.
  std::shared_ptr<const std::vector<DrawnMeasurement>> placedMeasurements() const;

  /// The camera in use: the scene's, or the one fitted to this view.
  Camera camera() const;
  bool hasItsPicture() const override {
    return View::hasItsPicture() && (!drawn_ || numberDrawn_ == numberAsked_);
  }
  /// What is under a position; none without a series or where nothing is seen.
  std::optional<Pick> pickAt(QPointF position) const;
  /// How much larger than when it was fitted last the object is shown: 1 after a standard view or a reset,
  /// whatever turns the camera or resizes the view since.
  double zoom() const;
  /// A standard view, whole; the projection stays.
  void showView(const QString& name);
  void resetView();
  /// Plays the steps in time, or stops.
  void togglePlay();
  const QWidget* canvas() const { return canvas_; }
  /// What is said of the picture: its level, and how long it took.
  const QString& caption() const { return caption_; }

 Q_SIGNALS:
  /// This picture is on show.
  void drawn(const volumen::ScreenPicture& picture);
  /// Something was drawn around with the scissors.
  void lassoDrawn(const volumen::SeriesKey& series, const volumen::Lasso& lasso);
  /// The key of a tool that draws was pressed.
  void toolWanted(const volumen::Tool& tool);
  /// A measurement was drawn, and no other is wanted.
  void toolDone();
  /// Why nothing can be measured where the pointer is, a sentence.
  void missed(const QString& sentence);

 protected:
  void seriesExchanged(bool another) override;
  void workspaceChanged(const Workspace& before) override;
  void resizeEvent(QResizeEvent*) override;
  void showEvent(QShowEvent*) override;
  void hideEvent(QHideEvent*) override;
  void enterEvent(QEnterEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void mouseDoubleClickEvent(QMouseEvent*) override;
  void wheelEvent(QWheelEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  bool event(QEvent*) override;
  bool hasMenu() const override { return series() != nullptr; }

 private:
  const Tool* toolFor(const QMouseEvent& event) const;
  ScenePress pressAt(QPointF position, Qt::KeyboardModifiers keys);
  void zoomAt(QPointF position, double factor);
  void takePickBack();
  void tellMissed(QPointF position);
  bool isSeenAt(QPointF position, const Shape& shape, std::size_t point) const;
  std::unique_ptr<SceneDrag> pressMeasurement(const ScenePress& press);
  void releaseShape(const QMouseEvent& event);
  bool pressMeasuringKey(const QKeyEvent& event);
  void showCursorAt(QPointF position);
  QString measurementText(QPointF position) const;
  /// Ends a drag, and what is being drawn; what was done to the workspace stays.
  void letGo();
  /// Ends a drag as if it had not been; without one, what is being drawn.
  void giveUp();
  void editCamera(const QString& what, const Camera& camera);
  void rememberFit(const Camera& fitted);
  Scene sceneToDraw() const;
  const Scene& scene() const { return session_.sceneOf(id()); }
  glm::dvec2 size() const { return {double(width()), double(height())}; }
  Overlays overlays() const;
  QRectF overlayArea() const;
  QString textAt(QPointF position) const override;
  void paintShown(QPainter& painter) const override;
  std::vector<QWidget*> badges() const override;
  QStringList warningsShown() const override;
  void paintEvent(QPaintEvent*) override {}  // its canvas is over all of it
  void paintCanvas(QPainter& painter) const;
  /// Something of what is seen changed: measurements are placed anew.
  void redraw();
  std::vector<DrawnMeasurement> placeMeasurements() const;
  void paintMeasured(QPainter& painter) const;
  void paintCrosshair(QPainter& painter) const;
  /// Where a place is seen; none: behind the eye.
  std::optional<QPointF> seenAtPlace(const Camera& camera, glm::dvec3 pPatient) const;
  /// Of the same frame of reference.
  bool planesOnScreen() const;
  void makeErrorImage();
  void replaceCanvas();
  void showDrawn(const ScreenPicture& picture);
  void showOld();
  void placeChildren();
  void followDrawn(bool isOtherLook);
  void showWarnings();
  void showState();

  DrawService& drawService_;
  QWidget* canvas_;
  OrientationCube* cube_;
  WarningBadge* badge_;
  QToolButton* showTable_;  // where the table is left out
  CineBar* cine_;
  int numberAsked_ = 0, numberDrawn_ = 0;  // of the requests of pictures
  VolumePtr drawn_;                        // the one that a picture was asked for
  Scene drawnScene_;                       // and of what
  std::optional<VolumeRange> only_;
  bool isDrawn_ = false;  // since there has been one
  QImage picture_;
  QString caption_, captionIfOld_;
  std::shared_ptr<const std::vector<float>> error_;
  ErrorImage errorImage_;  // of it, where errorShown_
  bool errorShown_ = false;
  const Tool* tool_ = &toolNamed("rotate");
  mutable std::shared_ptr<const std::vector<DrawnMeasurement>> placed_;  // until what is seen changes
  mutable double placedZoom_ = 1;                                        // written beside them
  mutable QImage painted_;         // `placed_`, where they are many; null: not painted yet
  const Tool* drawing_ = nullptr;  // what setFlatTool() gave it to draw
  QTimer wheelEnd_;
  std::map<int, double> fitMm_;  // height of fitted cameras, by the number of undo steps when they came

  // Of the gesture under way.
  std::unique_ptr<SceneDrag> drag_;
  bool shapePressed_ = false;         // for a point of it
  std::unique_ptr<SceneDrag> shape_;  // draws a measurement, by several presses; others may move the camera
  Qt::MouseButton dragButton_ = Qt::NoButton;
  QPointF pressedAt_;
  bool pressedShape_ = false;            // a measurement, not what lies behind it
  bool pressedFree_ = false;             // no measurement, where one could have been selected
  int stepsAtPress_ = 0;                 // of the undo stack
  bool isChosenByPress_ = false;         // it came into focus
  std::optional<Workspace> beforePick_;  // of the last click, where that moved the crosshair
};

}  // namespace volumen
