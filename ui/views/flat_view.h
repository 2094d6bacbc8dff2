#pragma once

#include <QImage>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>

#include "results/pictures/overlays.h"
#include "ui/controller/slice_service.h"
#include "ui/tools/tool.h"
#include "ui/views/stack_bar.h"
#include "ui/views/view.h"
#include "ui/views/view_makers.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/stack.h"
#include "ui/workspace/window_keys.h"

class QNativeGestureEvent;

namespace volumen {

class CineBar;
class WarningBadge;
class WindowEdit;
struct ColourBar;
struct DrawnMeasurement;
struct ReferenceLine;

/// Marks that all flat views draw and that are not part of the workspace.
struct Highlights {
  bool clip = false;                     ///< whether a clip box of the whole volume is shown
  std::optional<VolumeRange> segment{};  ///< tinted in slices of its volume
};

/// A view of a planar picture that is always drawn completely, without drafts. The left button acts as the
/// tool, the other buttons and the wheel as bound (ui/tools/mouse_bindings). A pinch zooms, a right click
/// opens a menu. Derived classes define the picture, its texts and its windows.
class FlatView : public View {
  Q_OBJECT
 public:
  ~FlatView() override;

  const QImage& picture() const { return picture_; }
  /// Returns the plane on screen in device pixels; nothing without a series.
  std::optional<SlicePlane> plane() const;
  /// Returns the request for a picture of `pixels` with the width of the view; nothing without a series.
  std::optional<SliceRequest> requestFor(QSize pixels) const;
  /// Returns the size of the whole picture at its own resolution; empty without a series.
  QSize ownPixels() const;
  /// Returns the request for the whole picture at ownPixels(); nothing without a series.
  std::optional<SliceRequest> requestForOwnPixels() const;
  QImage capture() const override;
  /// Returns the capture drawn over `picture`, which replaces the picture on screen. It is drawn in place if
  /// the image is not shared, so large pictures cost no copy.
  QImage captureWith(QImage picture) const;
  /// Returns whether the results of all measurements in it are ready. Requests those that are missing.
  bool isMeasured() const;
  void setTool(const Tool& tool);
  void setHighlights(const Highlights& highlights);
  /// Returns the stack with the picture on screen.
  virtual Stack stack() const { return stackIn(session_.workspace(), id(), shown()); }
  /// Scrolls down by `steps`. A clip stops playing.
  void scroll(int steps);
  /// Scrolls to a position of the stack, from 0. A clip stops playing.
  void goTo(int place);
  /// Returns the stack bar; nothing if there is one position or nothing is shown.
  virtual std::optional<StackBar> stackBar() const;
  /// Opens a field for a slice or frame number at the number's position. Does nothing for a single picture.
  void typeNumber();
  /// Resets zoom, pan and slab thickness.
  void resetView();
  /// Returns the series on screen; a frame is a series of one slice. Returns null if nothing is in memory yet
  /// or the workspace has something else in this view.
  virtual LoadedSeriesPtr shown() const = 0;
  /// Returns why the picture cannot be shown; empty if it can.
  const QString& failure() const { return failure_; }
  /// Plays the view's frames, slices or time points, or stops at the current position.
  void togglePlay();
  bool isPlaying() const;
  /// Returns the texts over the picture. Valid only if shown() is not null.
  virtual Overlays overlays() const = 0;
  void invert();
  /// A window offered by name.
  struct WindowChoice {
    QString name;
    bool isChosen;
    WindowKey key{};
    ChosenWindow window{};
  };
  /// Returns the windows on offer: automatic, those of the file, of tissues, and the user's own. Empty if
  /// there is no choice.
  virtual std::vector<WindowChoice> windows() const = 0;
  /// Chooses one of windows(); ignores numbers beyond them.
  void chooseWindow(int number);
  /// Returns the window in use, in the values of shown(). Nothing for colours or if nothing is in memory.
  virtual std::optional<Window> windowShown() const = 0;
  /// Turns the picture by `by` in addition to its present orientation.
  void turnPicture(const QString& text, PictureTurn by);
  /// Zooms to `mmPerPixel` (device pixels) about the centre.
  void zoomTo(double mmPerPixel);
  /// Returns the shorter edge in mm of a pixel of the source. Valid only if shown() is not null.
  double ownPixelMm() const;
  /// Returns the visible measurements; the one being drawn is last.
  std::vector<DrawnMeasurement> drawnMeasurements() const;
  /// Planes of the stack: the one on screen and those at its ends.
  enum class StackPart { current, first, last };
  struct StackPlane {
    StackPart part;
    SlicePlane plane;
  };
  /// Returns the planes of a workspace that other views show as lines, first the one on screen. Empty without
  /// a position in the patient, or if the workspace has something else in this view. With `ends` includes the
  /// first and the last plane if known.
  std::vector<StackPlane> stackPlanesIn(const Workspace& workspace, bool ends) const;
  /// Returns the intersections with planes of other views on screen, as the preferences say. Those views
  /// share the frame of reference or are linked to it, and have no line of the crosshair.
  std::vector<ReferenceLine> referenceLines() const;
  /// Sets the function that finds a flat view by its id, or returns null.
  void setFinder(std::function<const FlatView*(ViewId)> find) { find_ = std::move(find); }

 Q_SIGNALS:
  /// The picture on screen now corresponds to the workspace.
  void settled();
  /// The key of a tool was pressed.
  void toolWanted(const volumen::Tool& tool);
  /// A measurement was drawn and no further one is expected.
  void toolDone();
  /// What its drag draws in all flat views changed.
  void drewInAll();

 protected:
  /// Text of the badge: short words, and whole sentences for details.
  struct Warnings {
    QStringList words, sentences;
  };

  FlatView(const ViewParts& parts, ViewId id, QWidget* parent);

  /// Returns this plane in the space of the series shown.
  virtual SlicePlane planeShown(const SlicePlane& plane) const { return plane; }
  /// Returns the request for the picture of a plane.
  virtual SliceRequest requestOf(const SlicePlane& plane) const = 0;
  /// Returns whether the picture corresponds to the workspace.
  virtual bool isWanted(const SliceRequest& request) const { return request == asked_; }
  /// Discards everything of the series shown before.
  virtual void forget();
  /// Requests the picture of the current workspace.
  virtual void ask() { askForPicture(); }
  void askForPicture();
  /// Stops playing at the current position.
  void stop();
  /// Scrolls to a position while playing.
  void moveTo(int place) { goToPlace(session_, id(), shown(), place); }
  /// Returns whether the picture corresponds to the workspace and no drag is in progress.
  bool isAtRest() const;
  virtual Warnings warnings() const = 0;
  virtual QString hoverText(QPointF position) const = 0;
  /// Paints lines below measurements and texts.
  virtual void paintLines(QPainter& painter) const;

  /// Returns the state of its series in this view (ui/workspace/view_window).
  SeriesState seriesState() const;
  /// Returns `words` about the window, marked if the window is of this view alone.
  QString windowLine(const QString& words) const;
  std::optional<SlicePress> pressAt(QPointF p) const;
  /// Returns the segment layers over the picture: of its series, of the overlaid series, and of segmentation
  /// objects.
  std::vector<SegmentLayer> segmentLayers() const;
  /// Returns "Key image" with its star if the picture is one.
  QString keyImageText() const;
  /// Returns the corner texts that fit, and the areas they have to avoid.
  Overlays cornersOf(const CornerTexts& texts) const;
  QRectF overlayArea() const;
  void tellWarnings();

  void workspaceChanged(const Workspace& before) override;
  void paintShown(QPainter& painter) const override;
  void paintWith(QPainter& painter, const QImage& picture) const;
  void paintOver(QPainter& painter) const;
  void paintDrags(QPainter& painter) const;
  std::vector<QWidget*> badges() const override;
  QStringList warningsShown() const override { return warnings().sentences; }
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
  bool hasMenu() const override { return shown() != nullptr; }
  void hideEvent(QHideEvent*) override;

  SliceService& service_;
  DerivedObjects& derived_;
  CineBar* cine_;
  Highlights highlights_;
  QString failure_;

 private:
  SlicePlane fittedPlane(const Workspace& workspace, QSize pixels) const;
  /// Returns whether a picture may be shown until the one requested last arrives.
  bool mayShow(const SliceRequest& request) const;
  void showPicture(const SlicePicture& picture);
  /// Returns whether its points lie in the patient.
  bool hasCursor() const;
  void makeThicker(int steps);
  /// Returns the measurements that its picture can show.
  std::vector<const Measurement*> measurements() const;
  /// Returns the frame that new shapes belong to; nothing if they belong to the patient.
  std::optional<ShapeFrame> shapeFrame() const;
  std::unique_ptr<Drag> pressLine(const SlicePress& press) const;
  bool isOnLine(const SlicePress& press) const;
  bool hasCrosshairTool() const { return tool_ == &toolNamed("crosshair"); }
  void paintColourBar(QPainter& painter) const;
  void typeBar(const ColourBar& bar);
  const Tool* toolFor(const QMouseEvent& event) const;
  bool takesCrosshair(const QMouseEvent& event);
  bool movesCrosshair(Qt::KeyboardModifiers keys) const;
  double wheelSign() const;
  void zoomBy(const SlicePress& press, double factor);
  bool pinch(const QNativeGestureEvent& event);
  QRectF cornerRect(const QString& line) const;
  QRectF windowRect() const;
  QRectF numberRect() const;
  bool pressCorner(QPointF p);
  void typeWindow();
  /// Opens two fields for a window of a series, stored values, or for its ends. Setting them is one undo
  /// step.
  WindowEdit* openWindowEdit(const Window& stored, const LoadedSeriesPtr& of, bool ends,
                             const std::function<void(const Window&)>& set);
  void closeFields();
  void placeBadge();
  void placeCineBar();
  QRectF stackArea() const;
  bool isOnStackBar(QPointF p) const;
  std::unique_ptr<Drag> pressStackBar(QPointF p);
  void tellEdges(QPointF p);
  void askForLens();
  void paintLens(QPainter& painter) const;
  QString textAt(QPointF position) const override;
  std::optional<MeasurementHit> measurementAt(QPointF p) const;
  std::unique_ptr<Drag> pressMeasurement(const SlicePress& press);
  void endDrag(Qt::KeyboardModifiers keys);
  void seeDrag();
  bool letGo();
  bool isDrawing() const;
  void showDrawing();
  std::unique_ptr<Drag> takeDrag();
  void giveUpDrag();
  bool liesAsDrawn() const;
  void askForName(int id);
  void addSegmentMaps(std::vector<SegmentLayer>& layers) const;
  void addSegmentsOf(const SeriesKey& series, const Rigid& fromPlane,
                     std::vector<SegmentLayer>& layers) const;
  QString measurementText(QPointF p) const;
  void showCursorAt(QPointF p);
  bool pressMeasuringKey(const QKeyEvent& event);
  bool pressToolKey(const QKeyEvent& event);
  bool pressWindowKey(const QKeyEvent& event);
  void paintTool(QPainter& painter) const;

  MeasuredNumbers& measurer_;
  SegmentEditing* const segments_;
  std::function<const FlatView*(ViewId)> find_ = [](ViewId) { return nullptr; };
  std::pair<SeriesKey, ViewKind> showed_;
  WarningBadge* badge_;
  const Tool* tool_;
  QImage picture_;
  std::optional<SliceRequest> asked_;  // the last request
  std::optional<SliceRequest> drawn_;  // the request of picture_
  std::unique_ptr<Drag> drag_;
  std::optional<SliceRequest> lensAsked_;  // the last lens request of drag_
  std::optional<SlicePicture> lens_;
  bool isBarThick_ = false;
  int stepsAtPress_ = 0;  // index of the undo stack
  QPointF pressedAt_;
  Qt::MouseButton dragButton_ = Qt::NoButton;  // button that began drag_
  // Pointer position when the crosshair key went down; empty once the pointer has moved on.
  std::optional<QPointF> heldAt_;
  QTimer wheelEnd_;
  double wheelRest_ = 0;  // fraction of a notch not yet scrolled
};

}  // namespace volumen
