#pragma once

#include "ui/controller/frame_service.h"
#include "ui/views/flat_view.h"

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
  Stack stack() const override;
  std::optional<StackBar> stackBar() const override;
  LoadedSeriesPtr shown() const override { return isCurrent() && frame_ ? frame_->slice : nullptr; }
  bool hasItsPicture() const override { return !isLoading(); }
  Overlays overlays() const override;
  std::vector<WindowChoice> windows() const override;
  std::optional<Window> windowShown() const override;

 protected:
  SlicePlane planeShown(const SlicePlane& plane) const override;
  SliceRequest requestOf(const SlicePlane& plane) const override;
  bool isWanted(const SliceRequest& request) const override;
  void forget() override;
  void ask() override;
  void seriesExchanged(bool) override {}
  Warnings warnings() const override;
  QString hoverText(QPointF position) const override;
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
  QTimer retry_;      // until it is read again
  // Frame that is due while a clip plays; it replaces the workspace's frame.
  std::optional<int> played_;
};

}  // namespace volumen
