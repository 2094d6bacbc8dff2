#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include "ui/controller/slice_service.h"
#include "ui/workspace/workspace.h"

namespace volumen {

class FrameService;

/// Shows single slices as acquired while the rest of a series is loaded. It begins with the middle slice; the
/// wheel scrolls. It lies over the views and is not part of the document.
class FirstImage : public QWidget {
  Q_OBJECT
 public:
  FirstImage(FrameService& frames, SliceService& slices, QWidget* parent);

  /// Reads a slice of the series and shows it as its volume will look, as far as that is known. Does nothing
  /// more after end(). `isPart`: more of the series comes.
  void begin(const SeriesState& state, bool isPart);
  /// Goes on with a series of which the one shown is a part, at the slice shown.
  void goOn(const SeriesState& state, bool isPart);
  void end();
  /// Draws the slice in the present size; needed only while hidden.
  void askForPicture();
  /// Returns the index of the slice on screen, from 0.
  int index() const { return frame_ ? frame_->key.index : 0; }
  /// Returns how many slices there are to scroll through, those to come not among them; 0: none yet.
  int count() const;
  /// Returns the SOP Instance UID of the slice on screen; empty if there is none.
  std::string sopInstanceUid() const;
  const QImage& picture() const { return picture_; }

 Q_SIGNALS:
  /// A slice was read; the widget is to be shown over the views.
  void appears();

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void wheelEvent(QWheelEvent*) override;

 private:
  void go(int index, int step);
  void takeFrame(int view, const LoadedFramePtr& frame);
  void takePicture(const SlicePicture& picture);
  SeriesState shownState() const;

  FrameService& frames_;
  SliceService& slices_;
  SeriesState state_;
  std::shared_ptr<const Series> series_;  // series of state_; null after end()
  bool isPart_ = false;
  int wanted_ = 0;
  double wheelRest_ = 0;  // fraction of a notch not yet scrolled
  LoadedFramePtr frame_;
  std::shared_ptr<const Series> shown_;  // series of frame_
  QImage picture_;
};

}  // namespace volumen
