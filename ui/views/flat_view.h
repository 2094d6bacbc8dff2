#pragma once

#include <QImage>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>

#include "ui/controller/slice_service.h"
#include "ui/overlays/overlays.h"
#include "ui/tools/tool.h"
#include "ui/views/stack_bar.h"
#include "ui/views/view.h"
#include "ui/views/view_makers.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/key_images.h"
#include "ui/workspace/window_keys.h"

class QNativeGestureEvent;

namespace volumen {

class CineBar;
class WarningBadge;
struct DrawnMeasurement;
struct ReferenceLine;

/// A picture in a plane, whole at every step: the left button as the tool says, the others and the wheel
/// as they are bound (ui/tools/mouse_bindings), a pinch zooms, a right click opens a menu. What it is a
/// picture of, and what scrolling and windows mean there, say the classes made of it.
class FlatView : public View {
  Q_OBJECT
 public:
  ~FlatView() override;

  const QImage& picture() const { return picture_; }
  /// The plane on screen, device pixels; none without a series.
  std::optional<SlicePlane> plane() const;
  /// What is drawn for a picture of so many pixels that is as wide as the view; none without a series.
  std::optional<SliceRequest> requestFor(QSize pixels) const;
  /// The size of all of the picture, a pixel for each of its own; empty without a series.
  QSize ownPixels() const;
  /// What is drawn for a picture of that size; the view's own picture is whole. None without a series.
  std::optional<SliceRequest> requestForOwnPixels() const;
  QImage capture() const override;
  /// The same in as many pixels as this picture has, which takes the place of the one on screen: written over
  /// where nobody else has it, so that large ones take no longer than small ones.
  QImage captureWith(QImage picture) const;
  /// Whether the numbers of all that is measured in it are there; those that are not are asked for.
  bool isMeasured() const;
  void setTool(const Tool& tool);
  /// Shows what would be segments of a series under those that are; none: nothing more.
  void showPreview(const std::optional<SegmentMap>& segments);
  /// A ball that is being drawn in some view: slices show where they cut it. None: there is none.
  void showBall(const std::optional<DrawnBall>& ball);
  /// So many steps down.
  virtual void scroll(int steps) = 0;
  /// To a place of the stack, from 0; a clip ends there.
  virtual void goTo(int place) = 0;
  /// The bar of the stack; none where there is one place or nothing is shown.
  std::optional<StackBar> stackBar() const;
  /// Opens a field for the number to go to, where it stands; nothing where there is one picture.
  void typeNumber();
  /// Whole again, and thin.
  void resetView();
  /// What is on screen, as a series: frames as one of one slice; null: nothing is in memory yet, or the
  /// workspace has something else in this view's place.
  virtual LoadedSeriesPtr shown() const = 0;
  /// Why what is wanted cannot be shown; empty: it can.
  virtual QString failure() const { return {}; }
  /// Plays what the view goes through, or stops at what is on screen.
  void togglePlay();
  bool isPlaying() const;
  /// What is written over the picture. Only where shown() is something.
  virtual Overlays overlays() const = 0;
  void invert();
  /// A window to choose by name.
  struct WindowChoice {
    QString name;
    bool isChosen;
    WindowKey key{};
  };
  /// First the automatic one, then those of the file, of tissues, and the user's own; empty: there is none to
  /// choose.
  virtual std::vector<WindowChoice> windows() const = 0;
  virtual void chooseWindow(int number) = 0;
  /// The window in use, in the values of shown(); none: colours, or nothing is in memory.
  std::optional<Window> windowShown() const;
  /// Turned further than it is.
  void turnPicture(const QString& text, PictureTurn by);
  /// So many mm a device pixel, about the middle.
  void zoomTo(double mmPerPixel);
  /// mm of a pixel of what is shown, the smaller edge. Only where shown() is something.
  double ownPixelMm() const;
  /// What is true of its mm: "at detector"; empty: they are the patient's, or there are none.
  virtual QString lengthsWord() const { return {}; }
  /// The picture as acquired that is seen.
  virtual PictureSeen pictureSeen() const = 0;
  /// Where the wheel is, and of how many places.
  virtual StackPlace place() const = 0;
  /// Of how many the number of the picture is one; its places in the order of their numbers.
  int numberCount() const { return numbers().count; }
  std::vector<NumberedPlace> numberedPlaces() const;
  /// The measurements that are seen, the one that is being drawn last.
  std::vector<DrawnMeasurement> drawnMeasurements() const;
  /// A plane of the stack that is scrolled through: the one on screen, or one at an end.
  enum class StackPart { current, first, last };
  struct StackPlane {
    StackPart part;
    SlicePlane plane;
  };
  /// Those that other views show as lines, the one on screen first; none where it has no place in the
  /// patient. `ends`: with the first and the last one, where they are known.
  std::vector<StackPlane> stackPlanes(bool ends) const { return stackPlanesIn(session_.workspace(), ends); }
  /// The same as another workspace has them; none where that shows something else in this view's place.
  virtual std::vector<StackPlane> stackPlanesIn(const Workspace& workspace, bool ends) const;
  /// Where the planes of other views on screen cut this one, as the preferences say: those in the same frame
  /// of reference or one linked to it, but for those that have a line of the crosshair.
  std::vector<ReferenceLine> referenceLines() const;
  /// Who finds the view of an id; null: it is none of these.
  void setFinder(std::function<const FlatView*(ViewId)> find) { find_ = std::move(find); }

 Q_SIGNALS:
  /// The picture of what the workspace says is on screen.
  void settled();
  /// The key of a tool was pressed.
  void toolWanted(const volumen::Tool& tool);
  /// A measurement was drawn, and no other is wanted.
  void toolDone();

 protected:
  /// What the badge says: a few words, and whole sentences behind them.
  struct Warnings {
    QStringList words, sentences;
  };

  FlatView(const ViewParts& parts, ViewId id, QWidget* parent);

  /// This plane as what is shown has it.
  virtual SlicePlane planeShown(const SlicePlane& plane) const { return plane; }
  /// What its picture is made of.
  virtual SliceRequest requestOf(const SlicePlane& plane) const = 0;
  /// Whether a picture may be shown in place of the one asked for last, until that comes.
  virtual bool mayShow(const SliceRequest& request) const;
  /// Whether it is the one of what the workspace says.
  virtual bool isWanted(const SliceRequest& request) const;
  /// Whether the picture of the series shown before stays until there is one of this series.
  virtual bool keepsPictureOf(const SeriesKey& before) const = 0;
  /// Something else is shown: nothing of what was stays.
  virtual void forget();
  /// For what the workspace says.
  virtual void ask() { askForPicture(); }
  void askForPicture();
  /// False: it is of something else, or none was asked for.
  virtual bool showPicture(const SlicePicture& picture);

  /// The window in use.
  virtual Window greyWindow() const = 0;
  /// False of colours.
  virtual bool hasWindow() const { return true; }
  /// Whether its places are those of the patient.
  virtual bool hasCursor() const { return true; }
  virtual void makeThicker(int /*steps*/) {}
  /// What is played ends where it is.
  void stop();
  /// Whether the picture of what the workspace says is on screen, and no drag is under way.
  bool isAtRest() const;
  /// What is counted: the number of the picture shown, 0 where it has none, and of how many.
  struct Numbers {
    QString noun;
    int now = 0, count = 0;
  };
  virtual Numbers numbers() const = 0;
  /// The line of the corner that says it.
  virtual QString numberLine() const = 0;
  /// Where the wheel is at the picture of a number; none: it has no place.
  virtual std::optional<int> placeOf(int number) const = 0;
  /// Shows the picture of a number; why it cannot, empty: it does.
  virtual QString goToNumber(int number) = 0;
  /// Places of the stack that are key images.
  virtual std::vector<int> keyImagePlaces() const = 0;
  /// Runs of places that are in memory.
  virtual std::vector<std::pair<int, int>> heldPlaces() const = 0;
  /// With its planes as they lie where nobody turned them.
  virtual Workspace unturned(Workspace workspace) const { return workspace; }
  virtual Warnings warnings() const = 0;
  virtual QString hoverText(QPointF position) const = 0;
  virtual std::vector<const Measurement*> measurements() const = 0;
  /// What shapes that are drawn now belong to; none: to the patient.
  virtual std::optional<ShapeFrame> shapeFrame() const { return {}; }
  /// A drag by one of the lines over the picture; null: none is under the press.
  virtual std::unique_ptr<Drag> pressLine(const SlicePress& /*press*/) const { return nullptr; }
  /// Whether there is one.
  virtual bool isOnLine(const SlicePress& /*press*/) const { return false; }
  /// Under measurements and texts.
  virtual void paintLines(QPainter& painter) const;
  /// Over all.
  virtual void paintColours(QPainter& /*painter*/) const {}
  /// What is there to be dragged, on screen alone.
  virtual void paintHandles(QPainter& /*painter*/) const {}

  /// What holds for its series in this view (ui/workspace/view_window).
  SeriesState seriesState() const;
  /// These words about the window, and that it is of this view alone where it is.
  QString windowLine(const QString& words) const;
  std::optional<SlicePress> pressAt(QPointF p) const;
  /// Of the segments over the picture: of its series, of the one over that, of segmentation objects.
  std::vector<SegmentLayer> segmentLayers() const;
  /// "Key image" with its star, where it is one.
  QString keyImageText() const;
  /// The lines of the corners, as many as there is room for, and what else is in their way.
  Overlays cornersOf(const CornerTexts& texts) const;
  QRectF overlayArea() const;
  void tellWarnings();

  void workspaceChanged(const Workspace& before) override;
  void paintShown(QPainter& painter) const override;
  void paintWith(QPainter& painter, const QImage& picture) const;
  void paintOver(QPainter& painter) const;
  void paintDrawnBall(QPainter& painter) const;
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
  /// What the left button does.
  const Tool& tool() const { return *tool_; }
  void hideEvent(QHideEvent*) override;

  SliceService& service_;
  DerivedObjects& derived_;
  CineBar* cine_;

 private:
  SlicePlane fittedPlane(const Workspace& workspace, QSize pixels) const;
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

  MeasureJobs& measurer_;
  std::function<const FlatView*(ViewId)> find_ = [](ViewId) { return nullptr; };
  std::pair<SeriesKey, ViewKind> showed_;
  WarningBadge* badge_;
  const Tool* tool_;
  QImage picture_;
  std::optional<SliceRequest> asked_;  // the last
  std::optional<SliceRequest> drawn_;  // that of picture_
  std::unique_ptr<Drag> drag_;
  std::optional<DrawnBall> ball_;
  std::optional<SegmentMap> preview_;      // under those of its series
  std::optional<SliceRequest> lensAsked_;  // the last of drag_
  std::optional<SlicePicture> lens_;
  bool isBarThick_ = false;
  int stepsAtPress_ = 0;  // of the undo stack
  QPointF pressedAt_;
  Qt::MouseButton dragButton_ = Qt::NoButton;  // began drag_
  std::optional<QPointF> heldAt_;  // the pointer as the key of the crosshair went down; none: it went on
  QTimer wheelEnd_;
  double wheelRest_ = 0;  // notches not yet scrolled
};

}  // namespace volumen
