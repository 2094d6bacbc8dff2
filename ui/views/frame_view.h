#pragma once

#include "ui/controller/frame_service.h"
#include "ui/views/flat_view.h"
#include "ui/workspace/frame_look.h"

namespace volumen {

/// Shows the frames of a series as acquired, one at a time. The wheel changes the frame, and the frames can
/// be played as a clip.
class FrameView : public FlatView {
  Q_OBJECT
 public:
  FrameView(const ViewParts& parts, ViewId id, QWidget* parent);
  ~FrameView() override;

  /// Returns the frame on screen; null until one is read.
  const LoadedFramePtr& frame() const { return frame_; }
  /// Applies one of greyChoices().
  void chooseGrey(const GreyChoice& choice);
  void scroll(int steps) override;
  void goTo(int place) override;
  QString lengthsWord() const override {
    return frame_ ? QLatin1String(pixelSizeWord(frame_->pixel.kind)) : QString();
  }
  LoadedSeriesPtr shown() const override { return isCurrent() && frame_ ? frame_->slice : nullptr; }
  bool hasItsPicture() const override { return !isLoading(); }
  QString failure() const override { return failure_; }
  Overlays overlays() const override;
  std::vector<WindowChoice> windows() const override;
  void chooseWindow(int number) override;
  PictureSeen pictureSeen() const override;
  std::vector<StackPlane> stackPlanesIn(const Workspace& workspace, bool ends) const override;
  StackPlace place() const override;

 protected:
  SlicePlane planeShown(const SlicePlane& plane) const override;
  SliceRequest requestOf(const SlicePlane& plane) const override;
  bool mayShow(const SliceRequest& request) const override;
  bool isWanted(const SliceRequest& request) const override;
  bool keepsPictureOf(const SeriesKey&) const override { return false; }
  void forget() override;
  void ask() override;
  bool showPicture(const SlicePicture& picture) override;
  void seriesExchanged(bool) override {}
  Window greyWindow() const override;
  bool hasWindow() const override { return !frame_ || !frame_->colour(); }
  bool hasCursor() const override { return frame_ && frame_->geometry().calibrated; }
  Numbers numbers() const override;
  QString numberLine() const override;
  std::optional<int> placeOf(int number) const override { return number - 1; }
  QString goToNumber(int number) override;
  std::vector<int> keyImagePlaces() const override;
  std::vector<std::pair<int, int>> heldPlaces() const override;
  Warnings warnings() const override;
  QString hoverText(QPointF position) const override;
  std::vector<const Measurement*> measurements() const override;
  std::optional<ShapeFrame> shapeFrame() const override;
  void paintLines(QPainter& painter) const override;
  void hideEvent(QHideEvent*) override;
  bool isLoading() const override;

 private:
  class Clip;

  /// Returns whether the workspace has frames in this view.
  bool isCurrent() const { return showsFrames(state().kind); }
  FrameKey frameKey() const;
  void askForFrame();
  void takeFrame(int view, const LoadedFramePtr& frame);
  void tellFailure(int view, const FrameKey& key, const QString& sentence);
  QString presentationText() const;

  FrameService& frames_;
  LoadedFramePtr frame_;
  FrameKey awaited_;  // requested last
  QString failure_;   // of the wanted frame
  QTimer retry_;      // until it is read again
  // Frame that is due while a clip plays; it replaces the workspace's frame.
  std::optional<int> played_;
};

}  // namespace volumen
