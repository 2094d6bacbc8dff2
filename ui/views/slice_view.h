#pragma once

#include <QImage>
#include <QTimer>
#include <memory>
#include <optional>

#include "ui/controller/frame_service.h"
#include "ui/controller/slice_service.h"
#include "ui/overlays/overlays.h"
#include "ui/tools/tool.h"
#include "ui/views/view.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/key_images.h"

namespace volumen {

class CinePlayer;
class Measurer;
class References;
class TimeBar;
class WarningBadge;
struct DrawnMeasurement;

/// A plane through the volume of a series, whole at every step: the left button as the tool says, the wheel
/// scrolls, Ctrl+wheel zooms, Alt+wheel makes the slab thicker, Shift+move moves the crosshair everywhere, a
/// right click opens a menu. Or its frames as acquired: the same, with a frame in place of the volume.
class SliceView : public View {
  Q_OBJECT
 public:
  SliceView(Session& session, SliceService& service, FrameService& frames, Measurer& measurer,
            References& references, ViewId id, QWidget* parent = nullptr);
  ~SliceView() override;

  const QImage& picture() const { return picture_; }
  /// The plane on screen, device pixels; none without a series.
  std::optional<SlicePlane> plane() const;
  void setTool(const Tool& tool);
  /// Tints a segment in slices of its volume; null: none.
  void showSegment(const std::optional<VolumeRange>& segment);
  /// Whether the clip box of the 3D scene is seen where it is the whole volume, too.
  void setClipShown(bool shown);
  /// So many slices down the patient.
  void scroll(int steps);
  /// Whole again, and thin.
  void resetView();
  /// The frame on screen; null: none is read yet, or slices are shown.
  const ShownFramePtr& frame() const { return frame_; }
  /// Why the frame that is wanted cannot be shown; empty: it can.
  const QString& failure() const { return frameFailure_; }
  /// What is on screen, as a series: the frame as one of one slice; null: nothing is in memory yet.
  ShownSeriesPtr shown() const {
    if (state().kind == ViewKind::volume) return nullptr;
    return showsFrames() ? frame_ ? frame_->slice : nullptr : series();
  }
  bool showsFrames() const { return state().kind == ViewKind::frames; }
  /// The frames as a clip, or still again at the frame on screen; of slices the time points.
  void togglePlay();
  /// One of greyChoices().
  void chooseGrey(const GreyChoice& choice);
  /// What is written over the picture. Only where shown() is something.
  Overlays overlays() const;
  bool isPlaying() const { return player_ != nullptr; }
  void invert();
  /// The picture as acquired that is seen.
  PictureSeen pictureSeen() const;
  /// The measurements that are seen, the one that is being drawn last.
  std::vector<DrawnMeasurement> drawnMeasurements() const;

 Q_SIGNALS:
  /// The picture of what the workspace says is on screen.
  void settled();
  /// A right click: a menu is to be opened here.
  void menuRequested(QPoint global);
  /// The key of a tool was pressed.
  void toolWanted(const volumen::Tool& tool);
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
  void hideEvent(QHideEvent*) override;

 private:
  std::optional<SlicePress> pressAt(QPointF p) const;
  const Tool* toolFor(const QMouseEvent& event) const;
  GreyMapping grey() const;
  std::vector<SliceLayer> layers() const;
  void askForPicture();
  void showPicture(const SlicePicture& picture);
  void chooseWindow(int number);
  QRectF windowRect() const;
  void typeWindow();
  const SeriesState& seriesState() const;
  StackPlace place() const;
  bool hasCursor() const;
  void askForFrame();
  void takeFrame(int view, const ShownFramePtr& frame);
  void tellFrameFailure(int view, const FrameKey& key, const QString& sentence);
  void forgetFrame();
  void stop();
  FrameKey frameKey() const;
  QString frameHoverText(QPointF position) const;
  Overlays frameOverlays() const;
  void tellWarnings();
  void makeSlabThicker(int steps);
  void placeBadge();
  QString textAt(QPointF position) const override;
  QString hoverText(QPointF position) const;
  QRectF overlayArea() const;
  void placeTimeBar();
  void paintStackBar(QPainter& painter) const;
  void paintColours(QPainter& painter) const;
  void paintReferences(QPainter& painter) const;
  std::vector<SegmentLayer> segmentLayers() const;
  std::string frameOfReferenceShown() const;
  QStringList referenceTexts() const;
  std::optional<ShapeFrame> shapeFrame() const;
  std::optional<MeasurementHit> measurementAt(QPointF p) const;
  std::unique_ptr<Drag> pressMeasurement(const SlicePress& press);
  void endDrag(Qt::KeyboardModifiers keys);
  void askForName(int id);
  QString measurementText(QPointF p) const;
  void showCursorAt(QPointF p);
  bool pressMeasuringKey(const QKeyEvent& event);

  SliceService& service_;
  FrameService& frames_;
  Measurer& measurer_;
  References& references_;
  ShownFramePtr frame_;
  QString frameFailure_;  // why the frame that is wanted cannot be shown
  std::optional<std::pair<SeriesKey, ViewKind>> showed_;
  std::unique_ptr<CinePlayer> player_;  // while a clip is played
  WarningBadge* badge_;
  TimeBar* time_;
  const Tool* tool_;
  QImage picture_;
  std::optional<SliceRequest> asked_;  // the last
  std::unique_ptr<Drag> drag_;
  int stepsAtPress_ = 0;  // of the undo stack
  QPointF pressedAt_;
  bool clipShown_ = false;
  std::optional<VolumeRange> segment_;  // that is looked at alone
  QTimer wheelEnd_;
  double wheelRest_ = 0;  // notches not yet scrolled
};

}  // namespace volumen
