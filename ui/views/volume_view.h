#pragma once

#include <QImage>
#include <QTimer>
#include <map>

#include "results/pictures/overlays.h"
#include "ui/controller/draw_service.h"
#include "results/pictures/slice_image.h"
#include "ui/derivations/drawn_scenes.h"
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

/// Shows the rendering of a scene at device pixels and handles the mouse. Drags with the left button act as
/// the tool; other drags and the wheel act as bound (ui/tools/mouse_bindings). A pinch zooms, arrow keys
/// rotate, a double-click shows the view alone.
class VolumeView : public View {
  Q_OBJECT
 public:
  /// Without `segments`, tools change no segments.
  VolumeView(Session& session, const DrawnScenes& scenes, DrawService& drawService,
             SegmentEditing* segments = nullptr, ViewId id = sceneViewId, QWidget* parent = nullptr);

  /// Requests the picture again with the current settings of the service; cancels the request if hidden.
  void requestPicture();

  /// Shows a picture with its caption for the corner ("final: standard - 95 ms"). `error` is the error
  /// estimate per pixel, or null if unknown.
  void setPicture(const QImage& image, const QString& caption,
                  std::shared_ptr<const std::vector<float>> error = {});
  const QImage& picture() const { return picture_; }
  /// Shows the error estimate in place of the picture, if known.
  void setErrorShown(bool shown);
  /// Returns the picture on screen, or its error image.
  const QImage& shown() const;
  /// Draws only values of this range that the curve shows, in place of the scene's own range. Nothing
  /// restores the scene.
  void showOnly(const std::optional<VolumeRange>& range);
  void setTool(const Tool& tool);
  const Tool& tool() const { return *tool_; }
  /// Sets the tool of flat views. If it draws in 3D too, the left button uses it first.
  void setFlatTool(const Tool& tool);
  /// Returns whether the key of a tool that draws in 3D selects it here. It does not if the window uses the
  /// key otherwise.
  bool hasKey(const Tool& tool) const;
  /// Returns the visible measurements; the one being drawn is last. Points picked in 3D have handles unless
  /// hidden; other points belong to their slices.
  std::vector<DrawnMeasurement> drawnMeasurements() const { return *placedMeasurements(); }
  /// Returns the same list until something changes that it depends on.
  std::shared_ptr<const std::vector<DrawnMeasurement>> placedMeasurements() const;

  /// Returns the camera in use: the scene's, or the one fitted to this view.
  Camera camera() const;
  bool hasItsPicture() const override {
    return View::hasItsPicture() && (!drawn_ || numberDrawn_ == numberAsked_);
  }
  /// Returns what is under a position; nothing without a series or if nothing is seen.
  std::optional<Pick> pickAt(QPointF position) const;
  /// Returns the magnification since the camera was last fitted. It is 1 after a standard view or a reset;
  /// rotations and resizes do not change it.
  double zoom() const;
  /// Shows the whole object in a standard view; the projection stays.
  void showView(const QString& name);
  void resetView();
  /// Plays the time points, or stops.
  void togglePlay();
  const QWidget* canvas() const { return canvas_; }
  /// Returns the text about the picture: its quality level and duration.
  const QString& caption() const { return caption_; }

 Q_SIGNALS:
  /// This picture is now on screen.
  void drawn(const volumen::ScreenPicture& picture);
  /// An outline was drawn with the scissors.
  void lassoDrawn(const volumen::SeriesKey& series, const volumen::Lasso& lasso);
  /// The key of a drawing tool was pressed.
  void toolWanted(const volumen::Tool& tool);
  /// A measurement was drawn and no further one is expected.
  void toolDone();
  /// A sentence why nothing can be measured under the pointer.
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
  /// Ends a drag and a measurement being drawn. Changes of the workspace stay.
  void letGo();
  /// Cancels a drag and undoes its changes; without a drag, cancels the measurement being drawn.
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
  void paintEvent(QPaintEvent*) override {}  // fully covered by the canvas
  void paintCanvas(QPainter& painter) const;
  /// Places measurements anew and repaints, because the view has changed.
  void redraw();
  std::vector<DrawnMeasurement> placeMeasurements() const;
  void paintMeasured(QPainter& painter) const;
  void paintCrosshair(QPainter& painter) const;
  /// Returns where a point is seen; nothing if it is behind the eye.
  std::optional<QPointF> seenAtPlace(const Camera& camera, glm::dvec3 pPatient) const;
  /// Returns whether flat views of its frame of reference are on screen.
  bool planesOnScreen() const;
  void makeErrorImage();
  void replaceCanvas();
  void showDrawn(const ScreenPicture& picture);
  void showOld();
  void placeChildren();
  void followDrawn(bool isOtherLook);
  std::vector<Warning> allWarnings() const;
  void showWarnings();
  void showState();

  const DrawnScenes& scenes_;
  DrawService& drawService_;
  SegmentEditing* const segments_;
  QWidget* canvas_;
  OrientationCube* cube_;
  WarningBadge* badge_;
  QToolButton* showTable_;  // shown if the table is left out
  CineBar* cine_;
  int numberAsked_ = 0, numberDrawn_ = 0;  // of picture requests
  VolumePtr drawn_;                        // volume of the last request
  Scene drawnScene_;                       // scene of the last request
  std::optional<VolumeRange> only_;
  bool isDrawn_ = false;  // whether a picture of drawn_ was shown
  QImage picture_;
  std::vector<Warning> pictureWarnings_;
  QString caption_, captionIfOld_;
  std::shared_ptr<const std::vector<float>> error_;
  ErrorImage errorImage_;  // of error_, if errorShown_
  bool errorShown_ = false;
  const Tool* tool_ = &toolNamed("rotate");
  mutable std::shared_ptr<const std::vector<DrawnMeasurement>> placed_;  // empty after the view changed
  mutable double placedZoom_ = 1;                                        // at `placed_`
  mutable QImage painted_;         // `placed_` if they are many; null if not painted yet
  const Tool* drawing_ = nullptr;  // the tool from setFlatTool() if it draws
  QTimer wheelEnd_;
  std::map<int, double> fitMm_;  // height of fitted cameras by the undo index at which they came

  // State of the current gesture.
  std::unique_ptr<SceneDrag> drag_;
  bool shapePressed_ = false;  // whether a point of shape_ is being pressed
  // Draws a measurement with several presses; other drags may move the camera meanwhile.
  std::unique_ptr<SceneDrag> shape_;
  Qt::MouseButton dragButton_ = Qt::NoButton;
  QPointF pressedAt_;
  bool pressedShape_ = false;     // whether a measurement was pressed rather than what lies behind it
  bool pressedFree_ = false;      // whether no measurement was pressed although one could have been selected
  int stepsAtPress_ = 0;          // index of the undo stack
  bool isChosenByPress_ = false;  // whether the press gave the view the focus
  std::optional<Workspace> beforePick_;  // workspace before the last click if that moved the crosshair
};

}  // namespace volumen
